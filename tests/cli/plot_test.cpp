// SPDX-License-Identifier: MIT
#include "apps/output/plot.h"

#include <gmock/gmock.h>

#include "tests/cli/temp_folder.h"

namespace corvo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TimedPose PoseAt(double seconds, double x, double y, double z) {
  return {static_cast<TimeNs>(1e9 * seconds), SE3(SO3(), {x, y, z})};
}

const PoseSequence kForward = {PoseAt(10, 0, 0, 0), PoseAt(11, 0.5, 0.1, 2), PoseAt(12, 0, 0, 4)};
const PoseSequence kUpwards = {PoseAt(10, 0, 0, 0), PoseAt(11, 3, 2, 0.5)};

TEST(PlotScript, ViewIsFromAboveForYDownAndZUpWorlds) {
  EXPECT_THAT(PlotScript({{kForward}, {}}), HasSubstr("set xlabel 'x'\nset ylabel 'z'"));
  EXPECT_THAT(PlotScript({{kUpwards}, {}}), HasSubstr("set xlabel 'x'\nset ylabel 'y'"));
  EXPECT_THAT(PlotScript({{}, kUpwards}), HasSubstr("set xlabel 'x'\nset ylabel 'y'"));
}

TEST(PlotScript, BothAxesHaveTheSameLength) {
  EXPECT_THAT(PlotScript({{kForward}, {}}),
              HasSubstr("set xrange [-1.95:2.45]\nset yrange [-0.2:4.2]\n"));
}

TEST(PlotScript, ContainsEveryPositionWithItsTimeSinceTheStart) {
  const std::string script = PlotScript({{kForward}, {}});
  EXPECT_THAT(script, HasSubstr("0.500000 2.000000 0.100000 1.000000\n"));
  EXPECT_THAT(script, Not(HasSubstr("ground truth")));
}

TEST(PlotScript, DrawsEverySegmentInItsOwnColor) {
  const std::string script = PlotScript({{kForward, kUpwards}, kForward});
  EXPECT_THAT(script, HasSubstr("title 'estimate, segment 1' lw 2 lt 2"));
  EXPECT_THAT(script, HasSubstr("title 'ground truth'"));
}

TEST(DrawTrajectory, OutputIsReproducible) {
  test::TempFolder folder;
  ASSERT_TRUE(DrawTrajectory({{kForward, kUpwards}, kForward}, folder / "a.png"));
  ASSERT_TRUE(DrawTrajectory({{kForward, kUpwards}, kForward}, folder / "b.png"));
  EXPECT_EQ(test::ReadText(folder / "a.png"), test::ReadText(folder / "b.png"));
}

TEST(DrawTrajectory, DrawsTrajectoriesOfNoneOrOnePose) {
  test::TempFolder folder;
  EXPECT_TRUE(DrawTrajectory({}, folder / "none.png"));
  EXPECT_TRUE(DrawTrajectory({{{PoseAt(0, 0, 0, 0)}}, {}}, folder / "one.png"));
}

TEST(DrawTrajectory, LeavesNoFileOnFailure) {
  test::TempFolder folder;
  EXPECT_FALSE(DrawTrajectory({{kForward}, {}}, folder / "no/such/folder/a.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "no"));
}

TEST(MovePoses, TransformsThePositions) {
  const Sim3 twice(2.0, SO3(), Eigen::Vector3d(1, 0, 0));
  const PoseSequence moved = MovePoses(twice, kForward);
  EXPECT_EQ(moved[1].time_ns, kForward[1].time_ns);
  EXPECT_TRUE(moved[1].world_from_camera.translation().isApprox(Eigen::Vector3d(2, 0.2, 4)));
}

}  // namespace
}  // namespace corvo
