// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

namespace corvo {

/// Runs a program without arguments, which is searched for in $PATH, until it ends. Its standard
/// input is `input`, its standard output the file `output`; its messages are discarded. Returns
/// whether it succeeded.
bool RunProgram(const std::string& name, std::FILE* input, const std::filesystem::path& output);

}  // namespace corvo
