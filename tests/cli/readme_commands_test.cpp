// SPDX-License-Identifier: MIT
// These tests run every command of README.md and datasets/README.md in a folder with the layout
// described there.

#include <regex>
#include <sstream>

#include <gmock/gmock.h>

#include "apps/output/manifest.h"
#include "tests/cli/example_folder.h"
#include "tests/data/data_path.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

/// Returns the corvo and evo commands in shell code blocks, without comments.
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
  /// Runs a sequence. Its images show no scene, so that no frame has a pose; the ground truth that
  /// the run found is copied as the estimate, as if the run had been perfect.
  void RunSequence(const std::string& command) const {
    here_.ExpectRuns(command);
    const fs::path result = here_ / command.substr(command.find("-o ") + 3);
    const fs::path truth = result / "groundtruth.tum";
    if (!fs::exists(truth)) return;
    fs::copy_file(truth, result / "trajectory.tum", fs::copy_options::overwrite_existing);
    fs::copy_file(truth, result / "rotations.tum", fs::copy_options::overwrite_existing);
    WriteText(result / "trajectory.kitti", "");
    WriteManifest(result);
  }

  /// Writes a manifest of the files as they are.
  static void WriteManifest(const fs::path& result) {
    Manifest manifest;
    fs::remove(result / kManifestName);
    for (const fs::directory_entry& entry : fs::directory_iterator(result)) {
      if (entry.is_regular_file()) manifest.files.push_back(Describe(entry.path()));
    }
    WriteText(result / kManifestName, ToText(manifest));
  }

  /// Checks that the files in an evo command exist. evo_test.cpp runs evo itself.
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

TEST_P(ReadmeCommands, CommandsOfTheReadmeRun) {
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
