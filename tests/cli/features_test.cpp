// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "orb/extractor.h"
#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Returns line `index` (from 0) without its line end.
std::string Line(const std::string& text, int index) {
  std::istringstream stream(text);
  std::string line;
  for (int i = 0; i <= index; ++i) std::getline(stream, line);
  return line;
}

/// Formats the table line of a feature independently of the code under test.
std::string TableLine(const orb::Keypoint& keypoint, const orb::Descriptor& descriptor) {
  std::string line = fmt::format("{},{},{},{},{},", keypoint.x, keypoint.y, keypoint.octave,
                                 keypoint.angle_deg, keypoint.response);
  for (const int byte : descriptor.bytes) line += fmt::format("{:02x}", byte);
  return line;
}

/// A fixture with two images a.png and b.png; b.png shows the same scene shifted 7 px to the left.
class FeatureCommands : public testing::Test {
 protected:
  FeatureCommands() {
    const cv::Mat wide = TinyImage(1, 207, 150);
    WriteImage(a_, wide.colRange(0, 200));
    WriteImage(b_, wide.colRange(7, 207));
  }

  TemporaryFolder folder_;
  const fs::path a_ = folder_ / "a.png";
  const fs::path b_ = folder_ / "b.png";
  const fs::path out_ = folder_ / "out";
};

TEST_F(FeatureCommands, FeaturesAreDrawnAndListed) {
  const CommandResult result = RunCorvo({"features", a_, b_, "-o", out_});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("a.png: 1000 features\n"));
  EXPECT_EQ(CountLines(result.out), 2);
  const cv::Mat image = cv::imread(a_, cv::IMREAD_GRAYSCALE);
  const orb::Features features = orb::Extractor().Extract(image);
  const std::string table = ReadText(out_ / "a_features.csv");
  EXPECT_EQ(CountLines(table), 1001);
  EXPECT_EQ(Line(table, 0), "x,y,octave,angle,response,descriptor");
  for (const int i : {0, 500, 999}) {
    EXPECT_EQ(Line(table, i + 1), TableLine(features.keypoints[i], features.descriptors[i]));
  }
  const cv::Mat drawing = cv::imread(out_ / "b_features.png", cv::IMREAD_COLOR);
  EXPECT_EQ(drawing.size(), image.size());
  std::vector<cv::Mat> channels;
  cv::split(drawing, channels);
  EXPECT_GT(cv::countNonZero(channels[0] != channels[2]), 1000);
}

TEST_F(FeatureCommands, FeaturesFollowTheOptions) {
  WriteText(folder_ / "few.yaml", "extractor: {num_features: 12}\n");
  const CommandResult result =
      RunCorvo({"features", a_, "-o", out_, "--config", folder_ / "few.yaml"});
  EXPECT_THAT(result.out, HasSubstr("a.png: 12 features\n"));
  EXPECT_THAT(ReadText(out_ / "config.yaml"), HasSubstr("num_features: 12\n"));
}

TEST_F(FeatureCommands, ImagesWhoseResultsWouldCollideAreRejected) {
  WriteImage(folder_ / "other/a.png", TinyImage(2));
  const CommandResult result = RunCorvo({"features", a_, folder_ / "other/a.png", "-o", out_});
  EXPECT_EQ(result.exit_code, kBadInput);
  EXPECT_THAT(result.err, HasSubstr("both results would be named a_features"));
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(FeatureCommands, UnreadableImageLeavesNoOutput) {
  WriteText(folder_ / "text.png", "no image");
  const CommandResult result = RunCorvo({"features", a_, folder_ / "text.png", "-o", out_});
  EXPECT_EQ(result.exit_code, kBadInput);
  EXPECT_THAT(result.err, HasSubstr("text.png"));
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(FeatureCommands, MatchesAreDrawnListedAndCounted) {
  const CommandResult result = RunCorvo({"match", a_, b_, "-o", out_});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("a.png: 1000 features\n"));
  EXPECT_THAT(result.out, HasSubstr(" inliers of a homography\n"));
  const std::string table = ReadText(out_ / "matches.csv");
  EXPECT_EQ(Line(table, 0), "first,second,first_x,first_y,second_x,second_y,distance,inlier");
  EXPECT_GT(CountLines(table), 200);
  EXPECT_THAT(result.out, HasSubstr(fmt::format("\n{} matches, ", CountLines(table) - 1)));
  EXPECT_EQ(cv::imread(out_ / "matches.png").size(), cv::Size(400, 150));
  std::istringstream homography(ReadText(out_ / "homography.txt"));
  double h[9];
  for (double& entry : h) homography >> entry;
  EXPECT_NEAR(h[2] / h[8], -7, 0.5);
  EXPECT_NEAR(h[5] / h[8], 0, 0.5);
}

TEST_F(FeatureCommands, ImagesWithoutFeaturesHaveNoHomography) {
  ASSERT_EQ(RunCorvo({"match", a_, b_, "-o", out_}).exit_code, 0);
  WriteImage(folder_ / "gray.png", cv::Mat(150, 200, CV_8UC1, cv::Scalar(128)));
  const CommandResult result = RunCorvo({"match", a_, folder_ / "gray.png", "-o", out_});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\n0 matches, 0 inliers of a homography\n"));
  EXPECT_EQ(CountLines(ReadText(out_ / "matches.csv")), 1);
  EXPECT_FALSE(fs::exists(out_ / "homography.txt")) << "left over from the earlier result";
}

TEST_F(FeatureCommands, OutputIsReproducible) {
  const fs::path again = folder_ / "again";
  ASSERT_EQ(RunCorvo({"match", a_, b_, "-o", out_}).exit_code, 0);
  ASSERT_EQ(RunCorvo({"match", a_, b_, "-o", again}).exit_code, 0);
  for (const char* name : {"matches.csv", "matches.png", "homography.txt", "config.yaml"}) {
    EXPECT_EQ(ReadText(out_ / name), ReadText(again / name)) << name;
  }
}

}  // namespace
}  // namespace corvo::test
