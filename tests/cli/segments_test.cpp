// SPDX-License-Identifier: MIT
// These tests cover the results of `corvo run` on a film with a cut, which has two segments.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"
#include "tests/vo/two_walls.h"
#include "vo/io/config.h"
#include "vo/io/trajectory_io.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr int kFramesOfAScene = 15;

/// A fixture with the images of a steady drive through one scene and then, after a cut, through
/// another one.
class FilmWithACut : public testing::Test {
 protected:
  FilmWithACut() {
    int index = 100;  // All names have the same length.
    for (const std::uint64_t seed : {7, 20}) {
      for (const cv::Mat& image : MakeDrive(kFramesOfAScene, seed)) {
        WriteImage(folder_ / fmt::format("images/{}.png", index++), image);
      }
    }
    WriteText(folder_ / "camera.yaml",
              WriteCameraFile({PinholeCamera(), {}, "", std::vector<FreeParameter>()}));
  }

  CommandResult RunOn(int num_frames) const {
    return RunCorvo({"run", folder_ / "images", "--camera", folder_ / "camera.yaml", "--fps", "10",
                     "--count", std::to_string(num_frames), "-o", result_});
  }

  nlohmann::json Segments() const {
    return nlohmann::json::parse(ReadText(result_ / "summary.json"))["segments"];
  }

  TemporaryFolder folder_;
  const fs::path result_ = folder_ / "result";
};

TEST_F(FilmWithACut, SummaryStatesTheSegmentsAndTheOriginOfTheirScales) {
  const CommandResult run = RunOn(2 * kFramesOfAScene);
  EXPECT_EQ(run.exit_code, kLost) << run.err;
  const nlohmann::json segments = Segments();
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0]["index"], 0);
  EXPECT_EQ(segments[0]["first_frame"], 0);
  EXPECT_EQ(segments[0]["last_frame"], kFramesOfAScene - 1);
  EXPECT_EQ(segments[0]["num_poses"], kFramesOfAScene);
  EXPECT_EQ(segments[0]["scale"]["from"], "arbitrary");
  EXPECT_TRUE(segments[0]["scale"]["factor"].is_null());
  EXPECT_EQ(segments[1]["index"], 1);
  EXPECT_GE(segments[1]["first_frame"], kFramesOfAScene);
  EXPECT_EQ(segments[1]["last_frame"], 2 * kFramesOfAScene - 1);
  EXPECT_EQ(segments[1]["scale"]["from"], "median_speed");
  EXPECT_GT(segments[1]["scale"]["factor"], 1.2);
  EXPECT_LT(segments[1]["scale"]["factor"], 1.8);
  EXPECT_THAT(run.out, AllOf(HasSubstr("2 segments"), HasSubstr("\nsegment 0: frames 0-14, "),
                             HasSubstr("\nsegment 1: frames ")));
}

TEST_F(FilmWithACut, TrajectoryMarksTheSegmentsAndEachHasAFile) {
  RunOn(2 * kFramesOfAScene);
  const nlohmann::json segments = Segments();
  ASSERT_EQ(segments.size(), 2u);
  const std::string text = ReadText(result_ / "trajectory.tum");
  EXPECT_THAT(text, StartsWith("# timestamp tx ty tz qx qy qz qw\n"
                               "# segment 0: frames 0-14, 15 poses, scale arbitrary\n0.0"));
  const std::string mark = fmt::format(
      "# segment 1: frames {}-29, {} poses, scale guessed from the median speed before the loss, "
      "within a factor of {:.2g}\n",
      segments[1]["first_frame"].get<int>(), segments[1]["num_poses"].get<int>(),
      segments[1]["scale"]["factor"].get<double>());
  EXPECT_THAT(text, HasSubstr("\n" + mark));
  PoseSequence both;
  for (int i = 0; i < 2; ++i) {
    const fs::path file = result_ / fmt::format("trajectory_segment_{}.tum", i);
    const PoseSequence poses = ReadTum(file);
    EXPECT_EQ(poses.size(), segments[i]["num_poses"]);
    both.insert(both.end(), poses.begin(), poses.end());
  }
  EXPECT_THAT(ReadText(result_ / "trajectory_segment_1.tum"), HasSubstr(mark));
  const PoseSequence whole = ReadTum(result_ / "trajectory.tum");
  ASSERT_EQ(whole.size(), both.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(whole[i].time_ns, both[i].time_ns);
    EXPECT_EQ(whole[i].world_from_camera, both[i].world_from_camera);
  }
}

TEST_F(FilmWithACut, ASegmentToWhichTheFilmReturnsIsContinued) {
  int index = 100 + 2 * kFramesOfAScene;
  for (const cv::Mat& image : MakeDrive(kFramesOfAScene, 7)) {
    WriteImage(folder_ / fmt::format("images/{}.png", index++), image);
  }
  EXPECT_EQ(RunOn(3 * kFramesOfAScene).exit_code, kLost);
  const nlohmann::json segments = Segments();
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0]["last_frame"], 3 * kFramesOfAScene - 1);
  EXPECT_EQ(segments[0]["num_poses"], 2 * kFramesOfAScene);
  EXPECT_THAT(ReadText(result_ / "trajectory.tum"), HasSubstr("\n# segment 0, continued\n"));
  const PoseSequence whole = ReadTum(result_ / "trajectory.tum");
  EXPECT_EQ(whole.size(), 2 * kFramesOfAScene + segments[1]["num_poses"].get<std::size_t>());
  EXPECT_EQ(ReadTum(result_ / "trajectory_segment_0.tum").size(), 2u * kFramesOfAScene);
}

TEST_F(FilmWithACut, FilesOfSegmentsThatNoLongerExistAreRemoved) {
  RunOn(2 * kFramesOfAScene);
  ASSERT_TRUE(fs::exists(result_ / "trajectory_segment_1.tum"));
  WriteText(result_ / "trajectory_segment_best.tum", "not corvo's");
  WriteText(result_ / "trajectory_segment_7.tum", "not corvo's");
  EXPECT_THAT(RunOn(kFramesOfAScene).err, HasSubstr("trajectory_segment_7.tum: not written by"));
  fs::remove(result_ / "trajectory_segment_7.tum");
  EXPECT_TRUE(fs::exists(result_ / "trajectory_segment_1.tum"));
  EXPECT_EQ(RunOn(kFramesOfAScene).exit_code, kDone);
  EXPECT_EQ(Segments().size(), 1u);
  EXPECT_THAT(ReadText(result_ / "trajectory.tum"), Not(HasSubstr("segment")));
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(fs::exists(result_ / fmt::format("trajectory_segment_{}.tum", i)));
  }
  EXPECT_TRUE(fs::exists(result_ / "trajectory_segment_best.tum"));
}

}  // namespace
}  // namespace corvo::test
