#include "apps/output/track_pictures.h"

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/cli/expect_error.h"
#include "tests/cli/temp_folder.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Of a grey picture, with a keypoint at (20, 20) that sees landmark 7 and one at (60, 20) that
/// sees none.
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

/// How far a pixel is from grey.
int Colour(const cv::Mat& picture, int x, int y) {
  const auto& pixel = picture.at<cv::Vec3b>(y, x);
  return std::max({pixel[0], pixel[1], pixel[2]}) - std::min({pixel[0], pixel[1], pixel[2]});
}

TEST(DrawTracks, MarksWhatSeesALandmark) {
  const cv::Mat picture = DrawTracks(kImage, TwoKeypoints(), {}, {});
  ASSERT_EQ(picture.size(), kImage.size());
  EXPECT_GT(Colour(picture, 23, 20), 50);
  EXPECT_EQ(Colour(picture, 60, 20), 0);
  EXPECT_NE(picture.at<cv::Vec3b>(20, 60)[0], 40);
  EXPECT_EQ(picture.at<cv::Vec3b>(20, 40), cv::Vec3b(40, 40, 40));
}

TEST(DrawTracks, ShowsWhereALandmarkCameFrom) {
  const cv::Mat picture = DrawTracks(kImage, TwoKeypoints(), {}, {{7, {50, 20}}, {8, {100, 60}}});
  EXPECT_GT(Colour(picture, 40, 20), 50);
  EXPECT_EQ(Colour(picture, 100, 60), 0);
}

TEST(TrackPictures, AreNumberedAsTheFrames) {
  test::TempFolder folder;
  TrackPictures pictures(folder / "a/b");
  FrameResult result;
  result.index = 42;
  pictures.Add(kImage, TwoKeypoints(), result);
  EXPECT_EQ(cv::imread((folder / "a/b/000042.jpg").string()).size(), kImage.size());
}

TEST(TrackPictures, NeedAFolder) {
  TrackPictures("").Add(kImage, TwoKeypoints(), {});
  test::TempFolder folder;
  test::WriteText(folder / "file", "");
  EXPECT_THAT(test::ErrorOf([&] { TrackPictures pictures(folder / "file"); }),
              testing::HasSubstr("file: cannot be made"));
}

}  // namespace
}  // namespace corvo
