// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/commands/commands.h"
#include "tests/fuzz/targets.h"

namespace corvo::fuzz {
namespace {

/// Returns the lines of a text in reverse, as CLI::App::parse takes them.
std::vector<std::string> ReversedLines(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return {lines.rbegin(), lines.rend()};
}

}  // namespace

/// One argument a line. CLI11 calls exit codes other than 0 errors, and 0 help.
void FuzzCommandLine(Bytes bytes) {
  int exit_code = 0;
  CLI::App app("", "corvo");
  app.require_subcommand(0, 1);
  AddCommands(app, exit_code);
  // It is called once everything has been parsed and checked, before the command is executed.
  app.parse_complete_callback([] { throw CLI::Success(); });
  AllowError([&] {
    try {
      app.parse(ReversedLines(Input(bytes).Text()));
    } catch (const CLI::ParseError&) {  // The help or the error is printed.
    }
  });
}

}  // namespace corvo::fuzz
