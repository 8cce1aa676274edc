// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "tests/cli/command.h"
#include "tests/data/temporary_folder.h"

namespace corvo::test {

inline constexpr int kExampleFrames = 4;

/// Returns the poses of a non-planar path in TUM format.
std::string ExamplePoses(double first_s, double step_s);

/// A folder with tiny files under the names in the examples of --help and of the READMEs: a
/// sequence in every layout with its ground truth, images, a video, camera files. The images show
/// no scene, so that no run has a pose.
class ExampleFolder {
 public:
  ExampleFolder();

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  /// Runs a shell command in the folder.
  CommandResult Run(const std::string& command) const;
  /// Runs a shell command in the folder. Fails the test unless it exits with 0 or, for `corvo run`
  /// and `corvo calibrate`, with the exit code of a run without a pose.
  void ExpectRuns(const std::string& command) const;

 private:
  TemporaryFolder folder_;
};

}  // namespace corvo::test
