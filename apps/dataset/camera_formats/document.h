// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <yaml-cpp/yaml.h>

namespace corvo {

/// Returns the root of a document in the YAML, JSON or XML of a tool. The YAML may start with
/// "%YAML:1.0" as written by OpenCV, although this is not valid YAML. JSON is read without the
/// poses in "frames" at its top level. XML must be that of OpenCV: <opencv_storage>. A mapping
/// holds elements of XML, without their attributes. Throws corvo::Error with the file and, where it
/// is known, the line, if the text is malformed, or larger than kMaxYamlBytes (JSON:
/// kMaxCalibrationBytes).
YAML::Node ParseDocument(const std::string& text, const std::filesystem::path& file);

/// Like ParseDocument(), for the content of a file.
YAML::Node ReadDocument(const std::filesystem::path& file);

/// Returns whether a text starts like JSON or XML.
bool StartsLikeJson(std::string_view text);
bool StartsLikeXml(std::string_view text);

/// Parses OpenCV's XML.
YAML::Node ParseXml(std::string_view text, const std::filesystem::path& file);

/// Parses JSON. Returns an undefined node if the text is not JSON.
YAML::Node ParseJson(std::string_view text, const std::filesystem::path& file);

/// The largest number of values, lists and mappings in JSON, and of elements in XML. More is an
/// error: a camera has few.
inline constexpr int kMaxDocumentNodes = 100'000;
/// The deepest nesting of them.
inline constexpr int kMaxDocumentDepth = 16;

}  // namespace corvo
