// SPDX-License-Identifier: MIT
#include "apps/output/track_drawings.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "apps/output/film.h"
#include "apps/output/frame_drawing.h"
#include "tests/cli/expect_error.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Returns a frame with a keypoint at (x, 20) that observes landmark 7 and one at (60, 20) that
/// observes none.
Frame TwoKeypoints(float x = 20, int index = 0) {
  Frame frame;
  frame.index = index;
  frame.features.keypoints.resize(2);
  frame.features.keypoints[0].x = x;
  frame.features.keypoints[0].y = 20;
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

/// Returns the drawing of the last of frames whose landmark 7 is at (x, 20).
cv::Mat DrawLastOf(const std::vector<float>& x, const cv::Mat& mask = {}) {
  TrackHistory tracks;
  Frame frame;
  for (std::size_t i = 0; i < x.size(); ++i) {
    frame = TwoKeypoints(x[i], static_cast<int>(i));
    tracks.Add(frame);
  }
  return DrawTracks(kImage, mask, frame, tracks);
}

TEST(DrawTracks, MarksKeypointsThatObserveALandmark) {
  const cv::Mat image = DrawLastOf({20});
  ASSERT_EQ(image.size(), kImage.size());
  EXPECT_GT(Color(image, 20, 20), 30);
  EXPECT_EQ(Color(image, 60, 20), 0);
  EXPECT_NE(image.at<cv::Vec3b>(20, 60)[0], 40);
  EXPECT_EQ(image.at<cv::Vec3b>(20, 40), cv::Vec3b(40, 40, 40));
}

TEST(DrawTracks, DrawsALineThroughTheLastTenPixelsOfALandmark) {
  EXPECT_GT(Color(DrawLastOf({50, 20}), 40, 20), 30);
  std::vector<float> x(10, 20);
  x.insert(x.begin(), 180);
  EXPECT_EQ(Color(DrawLastOf(x), 100, 20), 0) << "older pixels are forgotten";
  x.pop_back();
  EXPECT_GT(Color(DrawLastOf(x), 100, 20), 30);
}

TEST(DrawTracks, ColorsTracksByTheirAge) {
  const auto color_at = [](std::size_t age) {
    return DrawLastOf(std::vector<float>(age, 20)).at<cv::Vec3b>(20, 20);
  };
  EXPECT_LT(color_at(1)[2] + 100, color_at(64)[2]) << "from blue to yellow";
  EXPECT_GT(color_at(1)[0], color_at(64)[0] + 50);
  EXPECT_NE(color_at(2), color_at(8));
  EXPECT_EQ(color_at(64), color_at(100));
}

TEST(DrawTracks, TintsWhatIsMaskedAndLeavesItVisible) {
  cv::Mat mask(kImage.size(), CV_8UC1, cv::Scalar(255));
  mask.rowRange(80, 100) = 0;
  cv::Mat bright = kImage.clone();
  bright.colRange(0, 100) = 200;
  TrackHistory tracks;
  const Frame frame = TwoKeypoints();
  tracks.Add(frame);
  const cv::Mat image = DrawTracks(bright, mask, frame, tracks);
  EXPECT_GT(Color(image, 190, 85), 50);
  EXPECT_EQ(Color(image, 190, 60), 0);
  EXPECT_GT(image.at<cv::Vec3b>(90, 50)[1], image.at<cv::Vec3b>(90, 150)[1] + 80);
}

FrameResult ResultOf(State state, Reason reason, int num_inliers, int num_matches) {
  FrameResult result;
  result.state = state;
  result.reason = reason;
  result.num_inliers = num_inliers;
  result.num_matches = num_matches;
  return result;
}

TEST(StateText, TellsStateReasonAndCounts) {
  EXPECT_EQ(StateText(ResultOf(State::kTracking, Reason::kNone, 143, 210)),
            "tracking, 143 of 210 landmarks");
  EXPECT_EQ(StateText(ResultOf(State::kLost, Reason::kTooFewInliers, 12, 40)),
            "lost: too few inliers, 12 of 40 landmarks");
  EXPECT_EQ(StateText(ResultOf(State::kInitializing, Reason::kLowParallax, 80, 100)),
            "initializing: low parallax, 80 of 100 matches");
  EXPECT_EQ(StateText(ResultOf(State::kLost, Reason::kUnreadableImage, 0, 0)),
            "lost: unreadable image");
}

/// Returns the largest Color() in the part of the caption with the state, for a frame with the
/// reason.
int CaptionColor(Reason reason) {
  const cv::Mat plain(400, 1200, CV_8UC3, cv::Scalar::all(0));
  const cv::Mat image = WithCaption(plain, ResultOf(State::kTracking, reason, 10, 20));
  EXPECT_GT(image.rows, plain.rows);
  int largest = 0;
  for (int y = plain.rows; y < image.rows; ++y) {
    for (int x = 0; x < 600; ++x) largest = std::max(largest, Color(image, x, y));
  }
  return largest;
}

TEST(WithCaption, ColorsTheStateOfAPosedFrameWithAReason) {
  EXPECT_EQ(CaptionColor(Reason::kNone), 0);
  EXPECT_GT(CaptionColor(Reason::kScaleUncertain), 100);
}

TEST(WithCaption, GrowsWithTheImageAndFitsNarrowOnes) {
  const auto bar = [](const cv::Size& size) {
    return WithCaption(cv::Mat(size, CV_8UC3, cv::Scalar::all(0)), {}).rows - size.height;
  };
  EXPECT_NEAR(bar({2400, 800}), 2 * bar({1200, 400}), 1);
  EXPECT_GT(bar({32, 24}), 0);
}

FrameResult PosedAt(double x, double z, int segment) {
  FrameResult result;
  result.segment = segment;
  result.world_from_camera = SE3(SO3(), {x, 0, z});
  return result;
}

TEST(PathInset, ShowsATurnToTheRightOnTheRight) {
  PathInset inset;
  for (const auto& [x, z] : {std::pair(0, 0), std::pair(0, 5), std::pair(5, 5)}) {
    inset.Add(PosedAt(x, z, 0));
  }
  cv::Mat image(400, 400, CV_8UC3, cv::Scalar::all(0));
  inset.Draw(image);
  cv::Point camera;
  int most = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (Color(image, x, y) > most) camera = {x, y}, most = Color(image, x, y);
    }
  }
  EXPECT_GT(camera.x, 360) << "at the upper right corner of the inset";
  EXPECT_LT(camera.y, 40);
  EXPECT_GT(image.at<cv::Vec3b>(60, 400 - 6 - 108 + 11)[0], 100) << "from below left";
}

TEST(PathInset, BeginsAnewWithASegment) {
  PathInset inset;
  for (const int z : {0, 1, 2}) inset.Add(PosedAt(0, z, 0));
  inset.Add(PosedAt(0, 0, 1));
  cv::Mat image(400, 400, CV_8UC3, cv::Scalar::all(0));
  inset.Draw(image);
  EXPECT_EQ(cv::countNonZero(image.reshape(1)), 0);
}

TEST(TrackDrawings, AreNumberedLikeTheFrames) {
  test::TemporaryFolder folder;
  TrackDrawings images(folder / "a/b");
  FrameResult result;
  result.index = 42;
  images.Add(kImage, cv::Mat(), TwoKeypoints(), result);
  result.index = 43;
  images.AddMissing(kImage.size(), result);
  for (const char* name : {"a/b/000042.jpg", "a/b/000043.jpg"}) {
    EXPECT_EQ(cv::imread((folder / name).string()).cols, kImage.cols);
  }
}

TEST(TrackDrawings, RequireAFolder) {
  TrackDrawings("").Add(kImage, cv::Mat(), TwoKeypoints(), {});
  test::TemporaryFolder folder;
  test::WriteText(folder / "file", "");
  EXPECT_THAT(test::ErrorOf([&] { TrackDrawings images(folder / "file"); }),
              testing::HasSubstr("file: cannot be created"));
}

TEST(FilmName, IsToldByItsExtension) {
  EXPECT_TRUE(IsFilmName("a/film.mp4"));
  EXPECT_TRUE(IsFilmName("film.AVI"));
  EXPECT_FALSE(IsFilmName("drawings"));
  EXPECT_FALSE(IsFilmName("drawings.2"));
  EXPECT_THAT(test::ErrorOf([] { IsFilmName("film.webm"); }),
              HasSubstr("allowed is .mp4, .mov, .mkv or .avi for a film"));
}

TEST(FilmFrameRate, IsThatOfTheMedianStep) {
  constexpr TimeNs kMs = 1'000'000;
  EXPECT_EQ(FilmFrameRate({}), 30);
  EXPECT_EQ(FilmFrameRate({0, 100 * kMs, 200 * kMs, 900 * kMs, 1000 * kMs}), 10);
  EXPECT_EQ(FilmFrameRate({0, 33'366'667, 66'733'333}), 29.97);
  EXPECT_EQ(FilmFrameRate({0, 0, 0}), 240);
  EXPECT_EQ(FilmFrameRate({0, 60'000 * kMs}), 1);
}

/// Draws frames 40 ms apart into a film.
void DrawFilm(const fs::path& file, int num_frames, bool is_complete) {
  TrackDrawings drawings(file);
  const cv::Mat image(75, 101, CV_8UC1, cv::Scalar(90));
  for (int i = 0; i < num_frames; ++i) {
    FrameResult result;
    result.index = i;
    result.time_ns = 40'000'000LL * i;
    if (i % 4 == 3) {
      drawings.AddMissing(image.size(), result);
    } else {
      drawings.Add(image, cv::Mat(), TwoKeypoints(20, i), result);
    }
  }
  EXPECT_FALSE(fs::exists(file) && num_frames == 20) << "not in place before it is whole";
  drawings.Finish(is_complete);
}

int CountImages(const fs::path& file) {
  cv::VideoCapture capture(file.string(), cv::CAP_FFMPEG);
  int count = 0;
  for (cv::Mat image; capture.read(image); ++count) EXPECT_GE(image.cols, 101);
  return count;
}

class FilmOf : public testing::TestWithParam<const char*> {};

TEST_P(FilmOf, HasEveryFrameAtTheirRate) {
  test::TemporaryFolder folder;
  const fs::path file = folder / (std::string("film") + GetParam());
  for (const int num_frames : {20, 5}) {
    DrawFilm(file, num_frames, true);
    EXPECT_EQ(CountImages(file), num_frames);
  }
  cv::VideoCapture capture(file.string(), cv::CAP_FFMPEG);
  EXPECT_NEAR(capture.get(cv::CAP_PROP_FPS), 25, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Formats, FilmOf, testing::Values(".mp4", ".mov", ".mkv", ".avi"),
                         [](const auto& format) { return std::string(format.param + 1); });

TEST(Film, OfAnIncompleteRunDoesNotReplaceThatOfACompleteOne) {
  test::TemporaryFolder folder;
  const fs::path file = folder / "film.mp4";
  DrawFilm(file, 3, false);
  EXPECT_EQ(CountImages(file), 3);
  DrawFilm(file, 8, true);
  DrawFilm(file, 4, false);
  EXPECT_EQ(CountImages(file), 8);
}

TEST(Film, ReplacesOnlyFilesOfCorvo) {
  test::TemporaryFolder folder;
  test::WriteText(folder / "film.mp4", "mine");
  EXPECT_THAT(test::ErrorOf([&] { TrackDrawings drawings(folder / "film.mp4"); }),
              HasSubstr("film.mp4: not written by an earlier corvo"));
  EXPECT_EQ(test::ReadText(folder / "film.mp4"), "mine");
}

TEST(Film, WithoutFramesIsNotWritten) {
  test::TemporaryFolder folder;
  DrawFilm(folder / "film.mp4", 0, true);
  EXPECT_TRUE(fs::is_empty(folder / "."));
}

}  // namespace
}  // namespace corvo
