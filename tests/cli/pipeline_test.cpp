#include <algorithm>
#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 40;
constexpr int kDone = 0;
constexpr int kLost = 3;

/// Lines that are no comments.
int CountPoses(const fs::path& file) {
  std::istringstream text(ReadText(file));
  int count = 0;
  for (std::string line; std::getline(text, line);) count += line.front() == '#' ? 0 : 1;
  return count;
}

/// `corvo synth`, `run` and `eval`, one after the other, on a rendered street.
class Pipeline : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    const CommandResult result =
        RunCorvo({"synth", "street", "-o", *folder_ / "street", "--frames", "40"});
    ASSERT_EQ(result.exit_code, kDone) << result.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static CommandResult RunOn(const fs::path& input, const fs::path& result,
                             const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run", input, "-o", result};
    arguments.insert(arguments.end(), {"--camera", *folder_ / "street/camera.yaml"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCorvo(arguments);
  }

  static fs::path Street() { return *folder_ / "street"; }
  static fs::path Truth() { return Street() / "groundtruth.txt"; }

  static std::unique_ptr<TempFolder> folder_;
};

std::unique_ptr<TempFolder> Pipeline::folder_;

TEST_F(Pipeline, PosesEveryFrameOfAStreet) {
  const fs::path result = *folder_ / "result";
  ASSERT_EQ(RunOn(Street(), result, {"--gt", Truth()}).exit_code, kDone);
  EXPECT_EQ(CountPoses(result / "trajectory.tum"), kFrames);
  const auto summary = nlohmann::json::parse(ReadText(result / "summary.json"));
  EXPECT_EQ(summary["posed"], kFrames);
  EXPECT_EQ(summary["segments"], 1);
  EXPECT_LT(summary["evaluation"]["ate"]["percent_of_path"], 0.5);
  const std::string vertices =
      "element vertex " +
      std::to_string(summary["landmarks"].get<int>() + summary["keyframes"].get<int>()) + "\n";
  EXPECT_THAT(ReadText(result / "map.ply"), testing::HasSubstr(vertices));
}

TEST_F(Pipeline, EvalSaysWhatRunSays) {
  const fs::path result = *folder_ / "result";
  ASSERT_EQ(RunOn(Street(), result, {"--gt", Truth()}).exit_code, kDone);
  const CommandResult eval = RunCorvo({"eval", result / "trajectory.tum", Truth(), "--json"});
  const auto measured = nlohmann::json::parse(eval.out);
  const auto summary = nlohmann::json::parse(ReadText(result / "summary.json"));
  EXPECT_NEAR(measured["ate"]["rmse"], summary["evaluation"]["ate"]["rmse"], 1e-9);
}

TEST_F(Pipeline, WritesTheSameBytesWithAnyNumberOfThreads) {
  const fs::path one = *folder_ / "one";
  const fs::path two = *folder_ / "two";
  ASSERT_EQ(RunOn(Street(), one, {"--gt", Truth(), "--threads", "1"}).exit_code, kDone);
  ASSERT_EQ(RunOn(Street(), two, {"--gt", Truth(), "--threads", "2"}).exit_code, kDone);
  for (const char* name : {"trajectory.tum", "keyframes.tum", "map.ply", "frames.csv",
                           "summary.json", "config.yaml", "trajectory.png"}) {
    EXPECT_EQ(ReadText(one / name), ReadText(two / name)) << name;
  }
}

TEST_F(Pipeline, SaysThatItWasLostPartWay) {
  const fs::path dark = *folder_ / "dark";
  fs::copy(Street(), dark, fs::copy_options::recursive);
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(dark / "rgb")) pictures.push_back(entry.path());
  std::sort(pictures.begin(), pictures.end());
  const cv::Mat picture = cv::imread(pictures[20].string());
  WriteImage(pictures[20], cv::Mat::zeros(picture.size(), CV_8UC1));
  const CommandResult result = RunOn(dark, *folder_ / "lost", {});
  EXPECT_EQ(result.exit_code, kLost);
  EXPECT_THAT(result.out, testing::StartsWith("lost part-way: 40 frames"));
}

}  // namespace
}  // namespace corvo::test
