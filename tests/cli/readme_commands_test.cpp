// SPDX-License-Identifier: MIT
// Every command of README.md and datasets/README.md is run, in a folder laid out as they say.

#include <regex>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/cli/example_folder.h"
#include "tests/data/data_path.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

/// The commands of corvo and evo in blocks of shell, without comments.
std::vector<std::string> CommandsIn(const std::string& markdown) {
  std::istringstream lines(markdown);
  std::vector<std::string> commands;
  bool is_shell = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) is_shell = line == "```sh";
    const bool is_command = std::regex_search(line, std::regex("^(corvo|evo_ape|evo_rpe) "));
    if (!is_shell || !is_command) continue;
    commands.push_back(std::regex_replace(line, std::regex(" *#.*$"), ""));
  }
  return commands;
}

class ReadmeCommands : public testing::TestWithParam<const char*> {
 protected:
  /// Of the frames of a sequence that shows nothing, none has a pose: as a run without a fault
  /// would leave it, the estimate is the truth that the run found.
  void RunSequence(const std::string& command) const {
    here_.ExpectRuns(command);
    const fs::path result = here_ / command.substr(command.find("-o ") + 3);
    const fs::path truth = result / "groundtruth.tum";
    if (!fs::exists(truth)) return;
    fs::copy_file(truth, result / "trajectory.tum", fs::copy_options::overwrite_existing);
    fs::copy_file(truth, result / "rotations.tum", fs::copy_options::overwrite_existing);
    WriteText(result / "trajectory.kitti", "");
  }

  /// evo itself is run in a test of its own: here, that there are the files it is given.
  void ExpectFiles(const std::string& command) const {
    std::istringstream words(command);
    for (std::string word; words >> word;) {
      const bool is_file = word.find('/') != std::string::npos;
      EXPECT_TRUE(!is_file || fs::exists(here_ / word)) << command;
    }
  }

  void RunCommand(const std::string& command) const {
    if (command.rfind("corvo run", 0) == 0) {
      RunSequence(command);
    } else if (command.rfind("evo", 0) == 0) {
      ExpectFiles(command);
    } else {
      here_.ExpectRuns(command);
    }
  }

  ExampleFolder here_;
};

TEST_P(ReadmeCommands, Run) {
  const auto commands = CommandsIn(ReadText(SourceDir() / GetParam()));
  EXPECT_GE(commands.size(), 4u);
  std::vector<std::string> of_any_result;
  for (const std::string& command : commands) {
    if (command.find("camera:0") != std::string::npos) continue;  // No camera is connected.
    if (command.find("RESULT") == std::string::npos) {
      RunCommand(command);
    } else {
      of_any_result.push_back(std::regex_replace(command, std::regex("RESULT"), "result/mh_01"));
    }
  }
  for (const std::string& command : of_any_result) RunCommand(command);
}

INSTANTIATE_TEST_SUITE_P(Files, ReadmeCommands, testing::Values("README.md", "datasets/README.md"),
                         [](const auto& param_info) {
                           return std::string(*param_info.param == 'd' ? "Datasets" : "Project");
                         });

}  // namespace
}  // namespace corvo::test
