// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <CLI/CLI.hpp>

namespace corvo {

/// Adds all subcommands of `corvo`, in the order of its help. Those that can end early set
/// `exit_code`, which must outlive the app.
void AddCommands(CLI::App& app, int& exit_code);

/// Returns all subcommands, in the order of the help.
std::vector<const CLI::App*> CommandsOf(const CLI::App& app);

}  // namespace corvo
