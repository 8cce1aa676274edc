// SPDX-License-Identifier: MIT
#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Returns the TUM line of pose i of a non-planar path: at i seconds and at the position
/// scale * (i, i % 3, i % 2), shifted by `lateral` along y.
std::string TumLine(int i, double scale, double lateral) {
  return fmt::format("{}.0 {} {} {} 0 0 0 1\n", i, scale * i, scale * (i % 3) + lateral,
                     scale * (i % 2));
}

std::string KittiLine(int i) {
  return fmt::format("1 0 0 {} 0 1 0 {} 0 0 1 {}\n", i, i % 3, i % 2);
}

class Eval : public testing::Test {
 protected:
  Eval() {
    for (int i = 0; i < kCount; ++i) {
      truth_text_ += TumLine(i, 1.0, 0.0);
      estimate_text_ += TumLine(i, 0.5, 0.0);
      kitti_text_ += KittiLine(i);
      times_text_ += fmt::format("{}.0\n", i);
    }
    WriteText(truth_, truth_text_);
    WriteText(estimate_, estimate_text_);
    WriteText(kitti_, kitti_text_);
    WriteText(times_, times_text_);
  }

  /// Returns the report of `corvo eval --json`.
  nlohmann::json Measure(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "eval");
    arguments.push_back("--json");
    const CommandResult result = RunCorvo(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }

  void ExpectError(const CommandResult& result, const std::string& message) const {
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, AllOf(StartsWith("corvo: error: "), HasSubstr(message)));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }

  static constexpr int kCount = 12;
  TemporaryFolder folder_;
  std::string truth_text_, estimate_text_, kitti_text_, times_text_;
  const fs::path truth_ = folder_ / "truth.tum";
  const fs::path estimate_ = folder_ / "estimate.tum";
  const fs::path kitti_ = folder_ / "kitti.txt";
  const fs::path times_ = folder_ / "times.txt";
};

TEST_F(Eval, FindsNoErrorUpToASimilarity) {
  const nlohmann::json report = Measure({estimate_, truth_});
  EXPECT_NEAR(report["ate"]["rmse"], 0.0, 1e-9);
  EXPECT_NEAR(report["truth_from_estimate"]["scale"], 2.0, 1e-9);
  EXPECT_EQ(report["pairs"], kCount);
  EXPECT_EQ(report["coverage"], 1.0);
}

TEST_F(Eval, MeasuresAShiftWithoutAlignment) {
  std::string shifted;
  for (int i = 0; i < kCount; ++i) shifted += TumLine(i, 1.0, i % 2 == 0 ? 0.3 : -0.3);
  WriteText(estimate_, shifted);
  const nlohmann::json report = Measure({estimate_, truth_, "--align", "none"});
  EXPECT_NEAR(report["ate"]["rmse"], 0.3, 1e-9);
  EXPECT_NEAR(report["ate"]["max"], 0.3, 1e-9);
  EXPECT_NEAR(report["rpe_frames"]["translation"]["rmse"], 0.6, 1e-9);
  EXPECT_NEAR(report["truth_from_estimate"]["scale"], 1.0, 1e-12);
}

TEST_F(Eval, Se3AlignmentKeepsTheScale) {
  const nlohmann::json report = Measure({estimate_, truth_, "--align", "se3"});
  EXPECT_NEAR(report["truth_from_estimate"]["scale"], 1.0, 1e-12);
  EXPECT_GT(report["ate"]["rmse"], 0.5);
}

TEST_F(Eval, CoverageIsTheShareOfGroundTruthWithAnEstimate) {
  WriteText(estimate_, TumLine(0, 0.5, 0) + TumLine(1, 0.5, 0) + TumLine(2, 0.5, 0));
  EXPECT_NEAR(Measure({estimate_, truth_})["coverage"], 3.0 / kCount, 1e-12);
}

TEST_F(Eval, ComparesTwoKittiFilesRowByRow) {
  const nlohmann::json report = Measure({kitti_, kitti_});
  EXPECT_EQ(report["pairs"], kCount);
  EXPECT_NEAR(report["ate"]["rmse"], 0.0, 1e-9);
}

TEST_F(Eval, RequiresTimesForASingleKittiFile) {
  ExpectError(RunCorvo({"eval", estimate_, kitti_}),
              "kitti.txt: KITTI format has no timestamps; give");
  EXPECT_EQ(Measure({estimate_, kitti_, "--times", times_})["pairs"], kCount);
  WriteText(times_, "0\n1\n");
  ExpectError(RunCorvo({"eval", estimate_, kitti_, "--times", times_}),
              "2 timestamps for 12 poses");
}

TEST_F(Eval, FindsTheTrajectoryOfARunAndTheGroundTruthOfADataset) {
  WriteText(folder_ / "result/trajectory.tum", estimate_text_);
  WriteText(folder_ / "rgbd/groundtruth.txt", truth_text_);
  EXPECT_EQ(Measure({folder_ / "result", folder_ / "rgbd"})["pairs"], kCount);
  WriteText(folder_ / "kitti/poses/07.txt", kitti_text_);
  WriteText(folder_ / "kitti/sequences/07/times.txt", times_text_);
  const nlohmann::json report = Measure({folder_ / "result", folder_ / "kitti/sequences/07"});
  EXPECT_EQ(report["pairs"], kCount);
  EXPECT_EQ(report["truth"], (folder_ / "kitti/poses/07.txt").string());
  ExpectError(RunCorvo({"eval", folder_ / "result"}), "groundtruth.tum: no ground truth: give GT");
  WriteText(folder_ / "result/groundtruth.tum", truth_text_);
  EXPECT_EQ(Measure({folder_ / "result"})["pairs"], kCount);
  ExpectError(RunCorvo({"eval", estimate_}), "no ground truth: give GT");
  ExpectError(RunCorvo({"eval", estimate_, folder_ / "kitti"}),
              "kitti: no ground truth in the layout");
}

TEST_F(Eval, PairsPosesWithinHalfAFrame) {
  std::string late;  // 0.49 s after poses 0 to 7, 0.4 s before 9 to 11, 0.51 s from pose 8.
  for (int i = 0; i < kCount - 1; ++i) {
    late += fmt::format("{} {} {} {} 0 0 0 1\n", i < 8 ? i + 0.49 : i + 0.6, i, i % 3, i % 2);
  }
  WriteText(truth_, late);
  EXPECT_EQ(Measure({estimate_, truth_})["max_dt_s"], 0.5);
  EXPECT_EQ(Measure({estimate_, truth_})["pairs"], kCount - 1);
  EXPECT_EQ(Measure({estimate_, truth_, "--max-dt", "0.45"})["pairs"], 3);
}

TEST_F(Eval, SelectsFramesByStateAndSegment) {
  WriteText(folder_ / "result/trajectory.tum", estimate_text_);
  std::string table = "index,timestamp,state,segment\n";
  for (int i = 0; i < kCount; ++i) {
    table += fmt::format("{},{}.000000000,{},{}\n", i, i, i < 4 ? "initializing" : "tracking",
                         i < 9 ? 0 : 1);
  }
  WriteText(folder_ / "result/frames.csv", table);
  const fs::path run = folder_ / "result";
  EXPECT_EQ(Measure({run, truth_, "--states", "tracking"})["pairs"], kCount - 4);
  EXPECT_EQ(Measure({run, truth_, "--states", "tracking,initializing"})["pairs"], kCount);
  EXPECT_EQ(Measure({run, truth_, "--segment", "1"})["pairs"], kCount - 9);
  EXPECT_EQ(Measure({run, truth_, "--segment", "0", "--states", "tracking"})["pairs"], 5);
  ExpectError(RunCorvo({"eval", run, truth_, "--states", "flying"}), "\"flying\" is not a state");
  ExpectError(RunCorvo({"eval", estimate_, truth_, "--states", "tracking"}), "frames.csv");
  WriteText(folder_ / "result/frames.csv", "index\n");
  ExpectError(RunCorvo({"eval", run, truth_, "--states", "tracking"}), "no column timestamp");
}

TEST_F(Eval, MeasuresRpeOverFramesSecondsAndMeters) {
  const nlohmann::json report =
      Measure({estimate_, truth_, "--rpe-frames", "3", "--rpe-seconds", "5", "--rpe-meters", "4"});
  EXPECT_EQ(report["rpe_frames"]["frames"], 3);
  EXPECT_EQ(report["rpe_frames"]["translation"]["count"], kCount - 3);
  EXPECT_EQ(report["rpe_time"]["seconds"], 5.0);
  EXPECT_EQ(report["rpe_time"]["rotation_deg"]["count"], kCount - 5);
  EXPECT_EQ(report["rpe_path"]["length"], 4.0);
  EXPECT_FALSE(Measure({estimate_, truth_}).contains("rpe_path"));
}

TEST_F(Eval, ReadsEurocFormat) {
  std::string euroc;
  for (int i = 0; i < kCount; ++i) {
    euroc += fmt::format("{}000000000,{},{},{},1,0,0,0\n", i, i, i % 3, i % 2);
  }
  WriteText(folder_ / "estimate.csv", euroc);
  EXPECT_NEAR(Measure({folder_ / "estimate.csv", truth_})["ate"]["rmse"], 0.0, 1e-9);
}

TEST_F(Eval, ErrorsNameTheMalformedLine) {
  WriteText(estimate_, truth_text_ + "99 1 2 3\n");
  ExpectError(RunCorvo({"eval", estimate_, truth_}), "estimate.tum:13: ");
  WriteText(estimate_, "1 2 3\n");
  ExpectError(RunCorvo({"eval", estimate_, truth_}), "estimate.tum:1: 3 columns");
  WriteText(estimate_, "# nothing\n");
  ExpectError(RunCorvo({"eval", estimate_, truth_}), "estimate.tum: contains no poses");
}

TEST_F(Eval, RejectsTrajectoriesWithoutCommonTimes) {
  std::string late;
  for (int i = 0; i < kCount; ++i) late += TumLine(i + 1000, 1.0, 0.0);
  WriteText(estimate_, late);
  const CommandResult result = RunCorvo({"eval", estimate_, truth_});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, StartsWith("corvo: error: "));
}

TEST_F(Eval, PrintsTheMeasures) {
  const CommandResult result = RunCorvo({"eval", estimate_, truth_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("ATE"), HasSubstr("RPE"), HasSubstr("100.0% of the")));
}

/// Returns the lines of a text.
std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(Eval, ComparesSeveralResultsInOneTable) {
  const std::string shifted = TumLine(0, 1, 0.5) + truth_text_.substr(TumLine(0, 1, 0).size());
  WriteText(folder_ / "a/trajectory.tum", estimate_text_);
  WriteText(folder_ / "a/frames.csv", "timestamp,state,segment\n0.0,tracking,0\n");
  WriteText(folder_ / "long name/trajectory.tum", shifted);
  const CommandResult result = RunCorvo(
      {"eval", folder_ / "a", folder_ / "long name", estimate_, "--gt", truth_, "--align", "se3"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = Lines(result.out);
  ASSERT_EQ(lines.size(), 5);
  EXPECT_THAT(lines[0], ContainsRegex("^result +posed +coverage +ATE +ATE +RPE 1 frame"));
  EXPECT_THAT(lines[1], ContainsRegex("^ +.frames. +.%. +.m. +.% of path. +.m. +.deg. +.m."));
  EXPECT_THAT(lines[2], ContainsRegex("^a +12/1 +100.0 +[0-9.]+ "));
  EXPECT_THAT(lines[3], ContainsRegex("^long name +12 +100.0 +0.1[0-9]+ "));
  EXPECT_THAT(lines[4], StartsWith("estimate.tum"));
  for (const std::string& line : lines) EXPECT_EQ(line.size(), lines[0].size());
}

TEST_F(Eval, ComparesEveryRunWithItsOwnTruth) {
  for (const char* name : {"a", "b", "c"}) {
    WriteText(folder_ / name / "trajectory.tum", estimate_text_);
    WriteText(folder_ / name / "groundtruth.tum", truth_text_);
  }
  EXPECT_EQ(Lines(RunCorvo({"eval", folder_ / "a", folder_ / "b"}).out).size(), 4);
  const nlohmann::json reports = Measure({folder_ / "a", folder_ / "b", folder_ / "c"});
  ASSERT_EQ(reports.size(), 3);
  EXPECT_EQ(reports[2]["truth"], (folder_ / "c/groundtruth.tum").string());
  EXPECT_EQ(reports[2], Measure({folder_ / "c"}));
  ExpectError(RunCorvo({"eval", folder_ / "a", folder_ / "b", "--plot", folder_ / "x.png"}),
              "several results need one ground truth");
}

TEST_F(Eval, TakesTheSecondOfTwoAsTruthUnlessItIsAResult) {
  WriteText(folder_ / "rgbd/groundtruth.txt", truth_text_);
  WriteText(folder_ / "rgbd/trajectory.tum", "a run into the folder of its dataset");
  EXPECT_EQ(Measure({estimate_, folder_ / "rgbd"})["pairs"], kCount);
}

TEST_F(Eval, NamesTheResultThatCannotBeEvaluated) {
  WriteText(folder_ / "late.tum", "1000 0 0 0 0 0 0 1\n1001 0 0 1 0 0 0 1\n");
  ExpectError(RunCorvo({"eval", estimate_, folder_ / "late.tum", "--gt", truth_}),
              "late.tum: no pose of 2 lies within");
}

TEST_F(Eval, NamesEqualResultsByTheirPaths) {
  for (const char* name : {"x/run", "y/run"}) {
    WriteText(folder_ / name / "trajectory.tum", estimate_text_);
  }
  EXPECT_THAT(RunCorvo({"eval", folder_ / "x/run", folder_ / "y/run", "--gt", truth_}).out,
              AllOf(HasSubstr("x/run/trajectory.tum "), HasSubstr("y/run/trajectory.tum ")));
}

TEST_F(Eval, WritesTheErrorsOfEveryPose) {
  std::string shifted;
  for (int i = 0; i < kCount; ++i) {
    shifted += fmt::format("{}.0 {} {} {} 0 0 0.7071067811865476 0.7071067811865476\n", i, i,
                           i % 3 + 0.25, i % 2);
  }
  WriteText(estimate_, shifted);
  const fs::path table = folder_ / "errors.csv";
  const auto eval = [&](std::vector<std::string> results) {
    results.insert(results.begin(), "eval");
    for (const std::string& more :
         {std::string("--gt"), truth_.string(), std::string("--align"), std::string("none"),
          std::string("--per-pose"), table.string()}) {
      results.push_back(more);
    }
    return RunCorvo(results);
  };
  EXPECT_EQ(eval({estimate_}).exit_code, 0);
  std::vector<std::string> lines = Lines(ReadText(table));
  ASSERT_EQ(lines.size(), kCount + 1);
  EXPECT_EQ(lines[0], "timestamp,translation_error_m,rotation_error_deg");
  EXPECT_EQ(lines[5], "4.000000000,0.25,90");
  EXPECT_EQ(eval({estimate_, truth_}).exit_code, 0);
  lines = Lines(ReadText(table));
  ASSERT_EQ(lines.size(), 2 * kCount + 1);
  EXPECT_EQ(lines[1], "estimate.tum,0.000000000,0.25,90");
  EXPECT_EQ(lines.back(), "truth.tum,11.000000000,0,0");
  WriteText(table, "mine");
  ExpectError(eval({estimate_}), "errors.csv: not written by an earlier corvo");
}

TEST_F(Eval, DrawsSeveralResults) {
  const fs::path figure = folder_ / "figure.svg";
  EXPECT_EQ(RunCorvo({"eval", estimate_, truth_, "--gt", truth_, "--plot", figure}).exit_code, 0);
  EXPECT_THAT(ReadText(figure), AllOf(HasSubstr("estimate.tum, ATE rmse"),
                                      HasSubstr("truth.tum, ATE rmse"), HasSubstr("2 results")));
}

TEST_F(Eval, DrawsAnImage) {
  const fs::path image = folder_ / "with 'quotes' and spaces.png";
  EXPECT_EQ(RunCorvo({"eval", estimate_, truth_, "--plot", image}).exit_code, 0);
  EXPECT_THAT(ReadText(image), StartsWith("\x89PNG"));
  const fs::path figure = folder_ / "figure.svg";
  EXPECT_EQ(RunCorvo({"eval", estimate_, truth_, "--plot", figure}).exit_code, 0);
  EXPECT_THAT(ReadText(figure), HasSubstr("estimate.tum: 12 poses, ATE rmse"));
  ExpectError(RunCorvo({"eval", estimate_, truth_, "--plot", folder_ / "figure.jpg"}),
              "the extension is \".jpg\"; allowed is .png, .pdf or .svg");
}

}  // namespace
}  // namespace corvo::test
