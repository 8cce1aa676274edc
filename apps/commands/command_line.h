// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace corvo {

/// The exit code of a command whose usage or input is invalid.
inline constexpr int kBadInput = 1;

/// Sends all messages of this process to standard error, one per line: "corvo: error: ...". It may
/// be called once.
void SetUpLogging();

/// Executes a command line, given without the name of the program. Results go to standard output,
/// messages to standard error, one per line: "corvo: error: ...". Returns the exit code.
int RunCommandLine(const std::vector<std::string>& arguments);

/// Like RunCommandLine(), but leaves the logger as it is, and throws corvo::Error for a usage or
/// input that is invalid.
int ExecuteCommandLine(const std::vector<std::string>& arguments);

}  // namespace corvo
