// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace corvo::test {

/// How a process ended and what it printed.
struct CommandResult {
  int exit_code = -1;  ///< -1 where it did not exit by itself.
  std::string out;
  std::string err;
};

/// Runs the built `corvo` with these arguments, no shell between.
CommandResult RunCorvo(const std::vector<std::string>& arguments);

/// As RunCorvo, with a PATH in which no other program is found.
CommandResult RunCorvoAlone(const std::vector<std::string>& arguments);

/// Runs any program, with the variables of `environment` ("NAME=value") and no others.
CommandResult RunProgram(const std::string& program, const std::vector<std::string>& arguments,
                         std::vector<std::string> environment);

/// Runs `corvo` and sends it SIGINT, as Ctrl-C does, as soon as `file` exists.
CommandResult InterruptCorvo(const std::vector<std::string>& arguments,
                             const std::filesystem::path& file);

/// Runs `corvo` with a terminal as standard error; what it shows there is `err`.
CommandResult RunCorvoOnTerminal(const std::vector<std::string>& arguments);

}  // namespace corvo::test
