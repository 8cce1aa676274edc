// SPDX-License-Identifier: MIT
#include "apps/output/track_drawings.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/cli/expect_error.h"
#include "tests/cli/temp_folder.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns a frame with a keypoint at (20, 20) that observes landmark 7 and one at (60, 20) that
/// observes none.
Frame TwoKeypoints() {
  Frame frame;
  frame.features.keypoints.resize(2);
  frame.features.keypoints[0].x = frame.features.keypoints[0].y = 20;
  frame.features.keypoints[1].x = 60;
  frame.features.keypoints[1].y = 20;
  frame.landmarks = {7, kNoId};
  return frame;
}

const cv::Mat kImage(100, 200, CV_8UC1, cv::Scalar(40));

/// Returns the difference between the largest and the smallest channel of a pixel: 0 for gray.
int Color(const cv::Mat& image, int x, int y) {
  const auto& pixel = image.at<cv::Vec3b>(y, x);
  return std::max({pixel[0], pixel[1], pixel[2]}) - std::min({pixel[0], pixel[1], pixel[2]});
}

TEST(DrawTracks, MarksKeypointsThatObserveALandmark) {
  const cv::Mat image = DrawTracks(kImage, cv::Mat(), TwoKeypoints(), {}, {});
  ASSERT_EQ(image.size(), kImage.size());
  EXPECT_GT(Color(image, 23, 20), 50);
  EXPECT_EQ(Color(image, 60, 20), 0);
  EXPECT_NE(image.at<cv::Vec3b>(20, 60)[0], 40);
  EXPECT_EQ(image.at<cv::Vec3b>(20, 40), cv::Vec3b(40, 40, 40));
}

TEST(DrawTracks, DrawsALineFromTheEarlierPixelOfALandmark) {
  const cv::Mat image =
      DrawTracks(kImage, cv::Mat(), TwoKeypoints(), {}, {{7, {50, 20}}, {8, {100, 60}}});
  EXPECT_GT(Color(image, 40, 20), 50);
  EXPECT_EQ(Color(image, 100, 60), 0);
}

TEST(DrawTracks, DarkensWhatIsMasked) {
  cv::Mat mask(kImage.size(), CV_8UC1, cv::Scalar(255));
  mask.rowRange(80, 100) = 0;
  const cv::Mat image =
      DrawTracks(cv::Mat(100, 200, CV_8UC1, cv::Scalar(200)), mask, TwoKeypoints(), {}, {});
  EXPECT_GT(Color(image, 190, 85), 50);
  EXPECT_EQ(Color(image, 190, 60), 0);
}

/// Returns the largest Color() in the line of the caption of a frame with the reason.
int CaptionColor(Reason reason) {
  FrameResult result;
  result.state = State::kTracking;
  result.reason = reason;
  const cv::Mat image = DrawTracks(kImage, cv::Mat(), TwoKeypoints(), result, {});
  int largest = 0;
  for (int y = 80; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) largest = std::max(largest, Color(image, x, y));
  }
  return largest;
}

TEST(DrawTracks, ColorsTheCaptionOfAPosedFrameWithAReason) {
  EXPECT_EQ(CaptionColor(Reason::kNone), 0);
  EXPECT_GT(CaptionColor(Reason::kScaleUncertain), 100);
}

TEST(TrackDrawings, AreNumberedLikeTheFrames) {
  test::TempFolder folder;
  TrackDrawings images(folder / "a/b");
  FrameResult result;
  result.index = 42;
  images.Add(kImage, cv::Mat(), TwoKeypoints(), result);
  EXPECT_EQ(cv::imread((folder / "a/b/000042.jpg").string()).size(), kImage.size());
}

TEST(TrackDrawings, RequireAFolder) {
  TrackDrawings("").Add(kImage, cv::Mat(), TwoKeypoints(), {});
  test::TempFolder folder;
  test::WriteText(folder / "file", "");
  EXPECT_THAT(test::ErrorOf([&] { TrackDrawings images(folder / "file"); }),
              testing::HasSubstr("file: cannot be created"));
}

}  // namespace
}  // namespace corvo
