// SPDX-License-Identifier: MIT
#include "apps/output/plot.h"

#include <iterator>
#include <sstream>

#include <gmock/gmock.h>

#include "apps/output/plot_file.h"
#include "apps/output/plot_format.h"
#include "apps/output/vertical_axis.h"
#include "tests/cli/expect_error.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using Rows = std::vector<std::vector<double>>;

TimedPose PoseAt(double seconds, double x, double y, double z, const SO3& rotation = {}) {
  return {static_cast<TimeNs>(1e9 * seconds), SE3(rotation, {x, y, z})};
}

const PoseSequence kForward = {PoseAt(10, 0, 0, 0), PoseAt(11, 0.5, 0.1, 2), PoseAt(12, 0, 0, 4)};
const PoseSequence kUpwards = {PoseAt(10, 0, 0, 0), PoseAt(11, 3, 2, 0.5)};

/// Returns a plot of estimates with the names "0", "1" ...
TrajectoryPlot PlotOf(const std::vector<PoseSequence>& estimates, const PoseSequence& truth = {}) {
  TrajectoryPlot plot;
  plot.title = "title";
  for (const PoseSequence& poses : estimates) {
    plot.estimates.push_back({std::to_string(plot.estimates.size()), poses, {}});
  }
  plot.truth = truth;
  return plot;
}

/// Returns the numbers of a data block of a script: across, along, height, seconds for poses.
Rows DataOf(const std::string& script, const std::string& block) {
  const std::string start = "$" + block + " << EOD\n";
  const std::size_t begin = script.find(start) + start.size();
  std::istringstream lines(script.substr(begin, script.find("EOD\n", begin) - begin));
  Rows rows;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    rows.emplace_back(std::istream_iterator<double>(numbers), std::istream_iterator<double>());
  }
  return rows;
}

/// Returns the pose in a world that has rotated by `target_from_world`.
PoseSequence Rotated(const SO3& target_from_world, const PoseSequence& poses) {
  return MovePoses(Sim3(1, target_from_world, Eigen::Vector3d::Zero()), poses);
}

/// Returns a path in the world of the first camera, whose y axis points down: 4 forward and 1 up,
/// then 3 to the right and 1 up.
PoseSequence ClimbingRightTurn() {
  const SO3 right = SO3::Exp({0, 1.5707963, 0});
  return {PoseAt(0, 0, 0, 0), PoseAt(1, 0, -1, 4), PoseAt(2, 3, -2, 4, right)};
}

/// Requires that the path rises and turns right, seen from above.
void ExpectClimbAndRightTurn(const PoseSequence& poses) {
  const Rows rows = DataOf(PlotScript(PlotOf({poses})), "estimate0");
  ASSERT_EQ(rows.size(), 3);
  EXPECT_NEAR(rows[1][2] - rows[0][2], 1, 1e-6) << "rises";
  EXPECT_NEAR(rows[2][2] - rows[1][2], 1, 1e-6) << "rises";
  const double ahead_x = rows[1][0] - rows[0][0], ahead_y = rows[1][1] - rows[0][1];
  const double then_x = rows[2][0] - rows[1][0], then_y = rows[2][1] - rows[1][1];
  EXPECT_NEAR(ahead_x * then_y - ahead_y * then_x, -12, 1e-5) << "clockwise";
}

TEST(PlotScript, ShowsAClimbAsARiseAndARightTurnToTheRight) {
  const Rows rows = DataOf(PlotScript(PlotOf({ClimbingRightTurn()})), "estimate0");
  EXPECT_THAT(rows[1], ElementsAre(0, 4, 1, 1)) << "x is across, z along";
  EXPECT_THAT(rows[2], ElementsAre(3, 4, 2, 2));
}

TEST(PlotScript, KeepsClimbAndTurnInWorldsWithAnyVertical) {
  constexpr double kQuarter = 1.5707963267948966;
  for (int axis = 0; axis < 3; ++axis) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      SCOPED_TRACE(testing::Message() << "axis " << axis << ", quarters " << quarters);
      ExpectClimbAndRightTurn(Rotated(SO3::Exp(quarters * kQuarter * Eigen::Vector3d::Unit(axis)),
                                      ClimbingRightTurn()));
    }
  }
}

/// A path that mostly climbs must not change what is above.
TEST(PlotScript, ShowsASteepClimbAsARise) {
  const PoseSequence poses = {PoseAt(0, 0, 0, 0), PoseAt(1, 0.1, -8, 1), PoseAt(2, 0.2, -9, 2)};
  const Rows rows = DataOf(PlotScript(PlotOf({poses})), "estimate0");
  EXPECT_EQ(rows[1][2], 8);
  EXPECT_EQ(rows[2][2], 9);
}

TEST(PlotScript, ViewIsFromAboveForYDownAndZUpWorlds) {
  EXPECT_THAT(PlotScript(PlotOf({kForward})),
              HasSubstr("set xlabel 'x [map units]'\nset ylabel 'z [map units]'"));
  const SO3 forward_along_y = SO3::Exp({-1.5707963, 0, 0});
  TrajectoryPlot plot = PlotOf({Rotated(forward_along_y, kForward)});
  plot.unit = std::string("m");
  EXPECT_THAT(PlotScript(plot), AllOf(HasSubstr("set xlabel 'x [m]'\nset ylabel 'y [m]'"),
                                      HasSubstr("set ylabel 'height [m]'")));
}

TEST(PlotScript, TakesTheVerticalFromTheTruthUnlessItHasNoRotations) {
  const PoseSequence z_up = Rotated(SO3::Exp({-1.5707963, 0, 0}), ClimbingRightTurn());
  EXPECT_THAT(PlotScript(PlotOf({kForward}, z_up)), HasSubstr("set ylabel 'y ["));
  EXPECT_THAT(PlotScript(PlotOf({z_up}, kForward)), HasSubstr("set ylabel 'y ["));
  EXPECT_FALSE(HasRotations(kForward));
}

TEST(PlotScript, BothAxesHaveTheSameLength) {
  EXPECT_THAT(PlotScript(PlotOf({kForward})),
              HasSubstr("set xrange [-1.95:2.45]\nset yrange [-0.2:4.2]\n"));
}

TEST(PlotScript, ContainsEveryPositionWithItsTimeSinceTheStart) {
  const std::string script = PlotScript(PlotOf({kForward}));
  EXPECT_THAT(script, HasSubstr("0.500000 2.000000 -0.100000 1.000000\n"));
  EXPECT_THAT(script, Not(HasSubstr("ground truth")));
  EXPECT_THAT(script, Not(HasSubstr("set ylabel 'error")));
}

TEST(PlotScript, DrawsTheErrorOfEveryPair) {
  TrajectoryPlot plot = PlotOf({kForward}, kForward);
  for (const TimedPose& pose : kForward) {
    const SE3 off(SO3(), pose.world_from_camera.translation() + Eigen::Vector3d(0.3, 0, 0.4));
    plot.estimates[0].pairs.push_back({pose.time_ns, off, pose.world_from_camera});
  }
  plot.ate_rmse = 0.5;
  const std::string script = PlotScript(plot);
  const Rows rows = DataOf(script, "error0");
  ASSERT_EQ(rows.size(), kForward.size());
  EXPECT_THAT(rows[2], ElementsAre(2, DoubleNear(0.5, 1e-9)));
  EXPECT_THAT(script, AllOf(HasSubstr("set ylabel 'error ["), HasSubstr(", 0.5 with lines")));
}

TEST(PlotScript, DrawsEveryEstimateInItsOwnColor) {
  const std::string script = PlotScript(PlotOf({kForward, kUpwards}, kForward));
  EXPECT_THAT(script, HasSubstr("title '0' lw 1.8 lc rgb '#0072B2'"));
  EXPECT_THAT(script, HasSubstr("title '1' lw 1.8 lc rgb '#D55E00'"));
  EXPECT_THAT(script, HasSubstr("title 'ground truth'"));
}

TEST(PlotScript, NamesFewOfManyEstimates) {
  const std::string script = PlotScript(PlotOf(std::vector<PoseSequence>(10, kForward)));
  EXPECT_THAT(script, AllOf(HasSubstr("title '4'"), HasSubstr("title 'and 5 more'"),
                            HasSubstr("$estimate9 using 1:2 with lines")));
  EXPECT_THAT(script, Not(HasSubstr("title '5'")));
}

TEST(PlotScript, InterruptsCurvesWherePosesAreMissing) {
  PoseSequence poses;
  for (const double seconds : {0, 1, 2, 3, 8, 12}) poses.push_back(PoseAt(seconds, 0, 0, seconds));
  const Rows rows = DataOf(PlotScript(PlotOf({poses})), "estimate0");
  std::vector<std::size_t> sizes;
  for (const auto& row : rows) sizes.push_back(row.size());
  EXPECT_THAT(sizes, ElementsAre(4, 4, 4, 4, 0, 4, 4, 0, 4, 4)) << "poses alone are drawn twice";
}

TEST(PlotScript, QuotesTitles) {
  TrajectoryPlot plot = PlotOf({kForward});
  plot.title = "it's\n`x` \\1";
  EXPECT_THAT(PlotScript(plot), HasSubstr("'it''s\\x0a`x` \\1'"));
}

class DrawTrajectoryAs : public testing::TestWithParam<const char*> {};

TEST_P(DrawTrajectoryAs, OutputIsWholeAndReproducible) {
  test::TemporaryFolder folder;
  const TrajectoryPlot plot = PlotOf({kForward, kUpwards}, kForward);
  const std::string a = std::string("a") + GetParam(), b = std::string("b") + GetParam();
  ASSERT_TRUE(DrawTrajectory(plot, folder / a));
  ASSERT_TRUE(DrawTrajectory(plot, folder / b));
  EXPECT_TRUE(IsWholePlot(folder / a));
  const std::string bytes = test::ReadText(folder / a);
  EXPECT_EQ(bytes, test::ReadText(folder / b));
  EXPECT_THAT(bytes, Not(HasSubstr("CreationDate (D:20")));
  test::WriteText(folder / a, bytes.substr(0, bytes.size() - 9));
  EXPECT_FALSE(IsWholePlot(folder / a));
  test::WriteText(folder / a, "");
  EXPECT_FALSE(IsWholePlot(folder / a));
}

TEST_P(DrawTrajectoryAs, DrawsTrajectoriesOfNoneOrOnePose) {
  test::TemporaryFolder folder;
  EXPECT_TRUE(DrawTrajectory({}, folder / (std::string("none") + GetParam())));
  EXPECT_TRUE(
      DrawTrajectory(PlotOf({{PoseAt(0, 0, 0, 0)}}), folder / (std::string("one") + GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Formats, DrawTrajectoryAs, testing::Values(".png", ".pdf", ".svg", ".PDF"),
                         [](const auto& format) { return std::string(format.param + 1); });

TEST(DrawTrajectory, LeavesNoFileOnFailure) {
  test::TemporaryFolder folder;
  EXPECT_FALSE(DrawTrajectory(PlotOf({kForward}), folder / "no/such/folder/a.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "no"));
}

TEST(PlotFile, MustHaveTheExtensionOfAFormat) {
  test::TemporaryFolder folder;
  for (const char* name : {"a.eps", "a", "pdf"}) {
    EXPECT_THAT(test::ErrorOf([&] { PlotFile(folder / name, false); }),
                AllOf(StartsWith("--plot: "), EndsWith("allowed is .png, .pdf or .svg")));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
}

TEST(PlotFile, ReplacesOnlyItsOwnAndNoCompleteOneByAnother) {
  test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.svg";
  PlotFile(file, false).Draw(PlotOf({kForward}), false);
  PlotFile(file, false).Draw(PlotOf({kUpwards}));
  const std::string complete = test::ReadText(file);
  PlotFile(file, false).Draw(PlotOf({kForward}), false);
  EXPECT_EQ(test::ReadText(file), complete);
  PlotFile(file, false).Draw(PlotOf({kForward}));
  EXPECT_NE(test::ReadText(file), complete);
  test::WriteText(file, "mine");
  EXPECT_THAT(test::ErrorOf([&] { PlotFile(file, false); }), HasSubstr("a.svg: not written by"));
  PlotFile(file, true).Draw(PlotOf({kUpwards}));
  EXPECT_EQ(test::ReadText(file), complete);
}

TEST(MovePoses, TransformsThePositions) {
  const Sim3 twice(2.0, SO3(), Eigen::Vector3d(1, 0, 0));
  const PoseSequence moved = MovePoses(twice, kForward);
  EXPECT_EQ(moved[1].time_ns, kForward[1].time_ns);
  EXPECT_TRUE(moved[1].world_from_camera.translation().isApprox(Eigen::Vector3d(2, 0.2, 4)));
}

}  // namespace
}  // namespace corvo
