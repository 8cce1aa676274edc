// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace corvo::test {

// Exit codes of `corvo`.
inline constexpr int kDone = 0;
inline constexpr int kBadInput = 1;
inline constexpr int kNeverInitialized = 2;
inline constexpr int kLost = 3;

/// The exit code and the output of a process.
struct CommandResult {
  int exit_code = -1;  ///< -1 if it did not exit normally.
  std::string out;
  std::string err;
};

/// Runs the built `corvo` with these arguments, without a shell.
CommandResult RunCorvo(const std::vector<std::string>& arguments);

/// Like RunCorvo(), but with a PATH in which no other program is found.
CommandResult RunCorvoAlone(const std::vector<std::string>& arguments);

/// Runs any program with only the variables of `environment` ("NAME=value").
CommandResult RunProgram(const std::string& program, const std::vector<std::string>& arguments,
                         std::vector<std::string> environment);

/// Runs `corvo` and sends it a signal as soon as `file` exists. Ctrl-C sends SIGINT.
CommandResult InterruptCorvo(const std::vector<std::string>& arguments,
                             const std::filesystem::path& file, int signal);

/// Runs `corvo` and sends it a signal while it reads the named pipe `pipe`.
CommandResult InterruptCorvoAtPipe(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& pipe, int signal);

/// Runs `corvo` with a terminal as standard error; `err` is the output there.
CommandResult RunCorvoOnTerminal(const std::vector<std::string>& arguments);

int CountLines(const std::string& text);

}  // namespace corvo::test
