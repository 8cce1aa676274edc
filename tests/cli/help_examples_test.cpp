// SPDX-License-Identifier: MIT
// These tests run every example that --help prints, in a folder with the files that it names.

#include <algorithm>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/cli/example_folder.h"

namespace corvo::test {
namespace {

/// Returns the command lines printed after "Examples:".
std::vector<std::string> ExamplesIn(const std::string& help) {
  std::istringstream lines(help.substr(std::min(help.find("Examples:"), help.size())));
  std::vector<std::string> examples;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  corvo ", 0) == 0) examples.push_back(line.substr(2));
  }
  return examples;
}

class HelpExamples : public testing::TestWithParam<const char*> {
 protected:
  /// Writes the files that a successful run leaves, for the ground truth that the example compares
  /// them with.
  void WriteResult(const std::string& example) const {
    const bool euroc = example.find("MH_01") != std::string::npos;
    const std::string poses = euroc ? ExamplePoses(1403636579.763556, 0.05) : ExamplePoses(0, 0.1);
    WriteText(here_ / "result/trajectory.tum", poses);
    WriteText(here_ / "result/groundtruth.tum", poses);
    std::string frames = "timestamp,state,segment\n";
    for (int i = 0; i < kExampleFrames; ++i) {
      frames += fmt::format("{:.9f},tracking,0\n", 0.1 * i);
    }
    WriteText(here_ / "result/frames.csv", frames);
    WriteText(here_ / "room/groundtruth.txt", poses);
  }

  void RunExample(std::string example) const {
    if (example.rfind("corvo eval", 0) == 0) WriteResult(example);
    example = example.substr(0, example.find(" #"));
    if (example.rfind("corvo synth", 0) == 0) {  // Renders fewer and smaller frames.
      example = std::regex_replace(example, std::regex("--(frames|width) [0-9]+"), "");
      example += " --frames 3 --width 64 --force";
    }
    if (example.rfind("corvo run room", 0) == 0) {
      here_.ExpectRuns("corvo synth room -o room --frames 3 --width 96 --force");
    }
    // The command does not replace the camera file of the other examples.
    if (example.rfind("corvo calibrate", 0) == 0) std::filesystem::remove(here_ / "camera.yaml");
    here_.ExpectRuns(example);
  }

  ExampleFolder here_;
};

TEST_P(HelpExamples, ExamplesOfTheHelpTextRun) {
  std::vector<std::string> arguments = {"--help"};
  if (*GetParam() != '\0') arguments.insert(arguments.begin(), GetParam());
  const std::vector<std::string> examples = ExamplesIn(RunCorvo(arguments).out);
  EXPECT_FALSE(examples.empty());
  for (const std::string& example : examples) {
    if (example.find("camera:0") == std::string::npos) RunExample(example);  // No camera here.
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, HelpExamples,
                         testing::Values("", "run", "eval", "synth", "config", "features", "match",
                                         "learn", "calibrate"),
                         [](const auto& param_info) {
                           return *param_info.param ? std::string(param_info.param) : "corvo";
                         });

}  // namespace
}  // namespace corvo::test
