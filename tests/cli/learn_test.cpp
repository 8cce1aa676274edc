// SPDX-License-Identifier: MIT
#include <algorithm>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "orb/pattern_file.h"
#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A fixture with a folder of three smooth images with many corners.
class Learn : public testing::Test {
 protected:
  Learn() {
    for (int i = 0; i < 3; ++i) {
      WriteImage(images_ / (std::to_string(i) + ".png"), SmoothImage(i, 320, 240));
    }
  }

  CommandResult RunLearn(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "learn");
    arguments.insert(arguments.end(), {"--keypoints", "1500"});
    return RunCorvo(arguments);
  }

  TemporaryFolder folder_;
  const fs::path images_ = folder_ / "images";
  const fs::path pattern_ = folder_ / "pattern.inc";
};

TEST_F(Learn, WritesAPatternThatTheOptionsAccept) {
  const CommandResult result = RunLearn({images_, "-o", pattern_, "--source", "a drawing"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("256 tests from 1500 keypoints of 3 images\n"));
  const std::string text = ReadText(pattern_);
  EXPECT_THAT(text, StartsWith("// Binary tests of 5x5 windows, learned by corvo learn from 3 "
                               "images:\n// a drawing\n// 1500 keypoints, each in two views."));
  EXPECT_NO_THROW(orb::ReadPattern(pattern_));
  const fs::path config = folder_ / "config.yaml";
  WriteText(config, "extractor:\n  pattern: " + pattern_.string() + "\n");
  const auto extract = [&](const fs::path& out, const std::vector<std::string>& tail) {
    std::vector<std::string> arguments = {"features", images_ / "0.png", "-o", out};
    arguments.insert(arguments.end(), tail.begin(), tail.end());
    EXPECT_EQ(RunCorvo(arguments).exit_code, 0);
    return ReadText(out / "0_features.csv");
  };
  EXPECT_NE(extract(folder_ / "learned", {"--config", config}), extract(folder_ / "default", {}));
}

TEST_F(Learn, PatternDoesNotDependOnThreadsOrImageOrder) {
  const fs::path again = folder_ / "again.inc";
  ASSERT_EQ(RunLearn({images_, "-o", pattern_, "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(RunLearn({images_ / "2.png", images_ / "0.png", images_ / "1.png", "-o", again,
                      "--threads", "2"})
                .exit_code,
            0);
  EXPECT_EQ(ReadText(again), ReadText(pattern_));
}

TEST_F(Learn, EarlierFileIsReplacedOnlyOnRequestAndOnSuccess) {
  WriteText(pattern_, "precious");
  EXPECT_THAT(RunLearn({images_, "-o", pattern_}).err, HasSubstr("pattern.inc: not written by"));
  EXPECT_EQ(RunLearn({folder_ / "none.png", "-o", pattern_, "--force"}).exit_code, kBadInput);
  EXPECT_EQ(ReadText(pattern_), "precious");
  EXPECT_EQ(RunLearn({images_, "-o", pattern_, "--force"}).exit_code, 0);
  EXPECT_NO_THROW(orb::ReadPattern(pattern_));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 3)
      << "only a manifest beside it";
  EXPECT_EQ(RunLearn({images_, "-o", pattern_}).exit_code, 0) << "its own file";
}

TEST_F(Learn, ShowsAProgressBarOnATerminal) {
  if (!fs::exists("/dev/pts/ptmx")) GTEST_SKIP() << "no pseudo-terminals here";
  const CommandResult shown =
      RunCorvoOnTerminal({"learn", images_, "-o", pattern_, "--keypoints", "1500"});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_THAT(shown.err, HasSubstr("] correlations up to 0."));
  EXPECT_THAT(shown.err, HasSubstr("256 of 256 tests"));
}

TEST_F(Learn, ErrorsNameTheInvalidInput) {
  const auto expect_error = [&](const std::vector<std::string>& arguments, const char* message) {
    const CommandResult result = RunLearn(arguments);
    EXPECT_EQ(result.exit_code, kBadInput);
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_THAT(result.out, IsEmpty());
  };
  fs::create_directory(folder_ / "empty");
  expect_error({folder_ / "empty", "-o", pattern_}, "empty");
  expect_error({folder_ / "none.png", "-o", pattern_}, "none.png: cannot be read");
  WriteText(folder_ / "text.png", "no image");
  expect_error({folder_ / "text.png", "-o", pattern_}, "text.png: not a readable image");
  expect_error({images_, "-o", folder_ / "empty"}, "empty: is a folder");
  expect_error({images_, "-o", folder_ / "text.png" / "p.inc"}, "text.png");
  expect_error({images_, "-o", pattern_, "--source", "two\nlines"}, "--source must be one line");
  expect_error({images_, "-o", pattern_, "--threads", "0"}, "--threads");
  EXPECT_FALSE(fs::exists(pattern_));
}

TEST_F(Learn, ImagesWithTooFewCornersAreErrors) {
  WriteImage(folder_ / "gray.png", cv::Mat(150, 200, CV_8UC1, cv::Scalar(128)));
  const CommandResult result = RunLearn({folder_ / "gray.png", "-o", pattern_});
  EXPECT_EQ(result.exit_code, kBadInput);
  EXPECT_THAT(result.err, HasSubstr("0 keypoints to learn from; at least 1000 are needed"));
  EXPECT_FALSE(fs::exists(pattern_));
}

}  // namespace
}  // namespace corvo::test
