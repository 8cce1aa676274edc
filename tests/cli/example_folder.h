// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "tests/cli/command.h"
#include "tests/cli/temp_folder.h"

namespace corvo::test {

inline constexpr int kExampleFrames = 4;

/// Poses that no plane holds, in TUM format.
std::string ExamplePoses(double first_s, double step_s);

/// A folder with tiny files under the names that the examples of --help and of the READMEs have:
/// a sequence in every layout with its ground truth, images, a video, camera files. The images
/// show no scene, so that no run has a pose.
class ExampleFolder {
 public:
  ExampleFolder();

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  /// Runs a line of shell there.
  CommandResult Run(const std::string& command) const;
  /// ... which must end well, or as a run without a pose does.
  void ExpectRuns(const std::string& command) const;

 private:
  TempFolder folder_;
};

}  // namespace corvo::test
