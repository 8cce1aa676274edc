// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <yaml-cpp/yaml.h>

namespace corvo {

/// Parses the one document of a YAML text; a text without one is a null node. Unlike
/// YAML::LoadAll(), ends for every text: that one finds documents without end behind a misplaced
/// comma or bracket, as in "&a,". Throws corvo::Error, whose message starts with "<file>:<line>: ",
/// if the text is not YAML or there is anything after the document.
YAML::Node ParseYaml(const std::string& text, const std::filesystem::path& file);

/// Like ParseYaml(), for the content of a file of at most kMaxYamlBytes.
YAML::Node ReadYaml(const std::filesystem::path& file);

}  // namespace corvo
