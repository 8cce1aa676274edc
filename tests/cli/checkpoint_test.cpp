// SPDX-License-Identifier: MIT
#include "apps/run/checkpoint.h"

#include <functional>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "apps/run/run_results.h"
#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"

namespace corvo {
namespace {

using test::ReadText;
using test::TemporaryFolder;

TEST(Checkpoint, IsASmallResultThatSaysThatItIsIncomplete) {
  TemporaryFolder folder;
  test::WriteKitti(folder / "gr\xfcn", 5);
  RunArguments arguments;
  arguments.input = folder / "gr\xfcn";
  const Interruption interruption;
  RunInputs inputs = ReadInputs(arguments, interruption);
  const OutputFolder output(folder / "out", PlanOfRun(false));
  Odometry odometry(inputs.camera, inputs.options);
  Checkpoint at_once(arguments, inputs, output, 0);
  Checkpoint later(arguments, inputs, output, 1e9);
  for (int i = 0; i < 3; ++i) {
    const auto image = inputs.source.Next();
    odometry.Process(image->image, image->time_ns);
  }
  later.Update(odometry);
  EXPECT_FALSE(std::filesystem::exists(output.checkpoint()));
  at_once.Update(odometry);
  const auto summary = nlohmann::json::parse(ReadText(output.checkpoint() / "summary.json"));
  EXPECT_EQ(summary["complete"], false);
  EXPECT_EQ(summary["frames"], 3);
  EXPECT_EQ(summary["frames_expected"], 5);
  EXPECT_THAT(summary["ended_by"], testing::HasSubstr("checkpoint"));
  EXPECT_THAT(ReadText(output.checkpoint() / "frames.csv"), testing::HasSubstr("\n2,0.2"));
  EXPECT_TRUE(std::filesystem::exists(output.checkpoint() / "trajectory.tum"));
  const auto manifest = ReadManifest(output.checkpoint() / kManifestName);
  ASSERT_TRUE(manifest);
  EXPECT_FALSE(manifest->is_complete);
  EXPECT_EQ(manifest->files.size(), 3u);
}

/// Tracks a rendered room and calls `after_frame` after each frame.
Trajectory TrackRoom(RunInputs inputs, const std::function<void(const Odometry&)>& after_frame) {
  Odometry odometry(inputs.camera, inputs.options);
  while (const auto image = inputs.source.Next()) {
    odometry.Process(image->image, image->time_ns);
    after_frame(odometry);
  }
  return odometry.Finish();
}

TEST(Checkpoint, DoesNotAffectTheResult) {
  CORVO_SKIP_IF_SHORT();
  TemporaryFolder folder;
  const auto room =
      test::RunCorvo({"synth", "room", "-o", folder / "room", "--frames", "60", "--width", "320"});
  ASSERT_EQ(room.exit_code, 0) << room.err;
  RunArguments arguments;
  arguments.input = folder / "room";
  arguments.camera = folder / "room/camera.yaml";
  const Interruption interruption;
  const RunInputs inputs = ReadInputs(arguments, interruption);
  const OutputFolder output(folder / "out", PlanOfRun(false));
  Checkpoint checkpoint(arguments, inputs, output, 0);
  const Trajectory with =
      TrackRoom(ReadInputs(arguments, interruption),
                [&](const Odometry& odometry) { checkpoint.Save(odometry, "test"); });
  const Trajectory without = TrackRoom(ReadInputs(arguments, interruption), [](const auto&) {});
  EXPECT_GT(with.PosedShare(), 0.9);
  ASSERT_EQ(with.frames.size(), without.frames.size());
  for (std::size_t i = 0; i < with.frames.size(); ++i) {
    EXPECT_EQ(with.frames[i].world_from_camera, without.frames[i].world_from_camera) << i;
  }
}

/// A file takes the place of the hidden folder in which checkpoints are staged.
TEST(Checkpoint, ThatCannotBeWrittenDoesNotEndTheRun) {
  TemporaryFolder folder;
  test::WriteKitti(folder / "images", 2);
  RunArguments arguments;
  arguments.input = folder / "images";
  const Interruption interruption;
  const RunInputs inputs = ReadInputs(arguments, interruption);
  const OutputFolder output(folder / "out", PlanOfRun(false));
  const Odometry odometry(inputs.camera, inputs.options);
  test::WriteText(folder / "out/.corvo-unfinished/checkpoint", "");
  Checkpoint(arguments, inputs, output, 0).Update(odometry);
  EXPECT_FALSE(std::filesystem::exists(output.checkpoint()));
}

}  // namespace
}  // namespace corvo
