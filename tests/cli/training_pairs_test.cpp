// SPDX-License-Identifier: MIT
#include "apps/synthetic/training_pairs.h"

#include <gmock/gmock.h>

#include "apps/synthetic/training_view.h"
#include "orb/pyramid.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

cv::Point2d Apply(const cv::Matx33d& homography, double x, double y) {
  const cv::Vec3d mapped = homography * cv::Vec3d(x, y, 1);
  return {mapped[0] / mapped[2], mapped[1] / mapped[2]};
}

bool SameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_L1) == 0;
}

TEST(MakeTrainingViewTest, PixelsLieWhereTheHomographyMapsThem) {
  cv::Mat image(200, 300, CV_8UC1, cv::Scalar(0));
  cv::circle(image, {210, 60}, 9, cv::Scalar(255), cv::FILLED);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TrainingView view = MakeTrainingView(image, seed);
    const cv::Point2d expected = Apply(view.view_from_image, 210, 60);
    const cv::Rect around(static_cast<int>(expected.x) - 20, static_cast<int>(expected.y) - 20, 41,
                          41);  // Mirror images may lie elsewhere.
    const cv::Moments moments = cv::moments(view.image(around) > 128, true);
    ASSERT_GT(moments.m00, 50);
    EXPECT_NEAR(around.x + moments.m10 / moments.m00, expected.x, 0.5) << "seed " << seed;
    EXPECT_NEAR(around.y + moments.m01 / moments.m00, expected.y, 0.5) << "seed " << seed;
  }
}

TEST(MakeTrainingViewTest, ContainsTheWholeImage) {
  const cv::Mat image = SmoothImage(1, 160, 120);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TrainingView view = MakeTrainingView(image, seed);
    for (const auto& [x, y] :
         {cv::Point(0, 0), cv::Point(159, 0), cv::Point(0, 119), cv::Point(159, 119)}) {
      const cv::Point2d corner = Apply(view.view_from_image, x, y);
      EXPECT_GE(std::min(corner.x, corner.y), -1e-9);
      EXPECT_LT(corner.x, view.image.cols);
      EXPECT_LT(corner.y, view.image.rows);
    }
  }
}

TEST(MakeTrainingViewTest, DependsOnTheSeedAlone) {
  const cv::Mat image = SmoothImage(1, 160, 120);
  EXPECT_TRUE(SameBytes(MakeTrainingView(image, 5).image, MakeTrainingView(image, 5).image));
  EXPECT_FALSE(SameBytes(MakeTrainingView(image, 5).image, MakeTrainingView(image, 6).image));
}

class FindAgainTest : public testing::Test {
 protected:
  /// Returns the keypoints of `second` that are found again for one keypoint at (100, 50) if the
  /// view is enlarged by `zoom`.
  std::vector<orb::Keypoint> Find(int octave, double zoom,
                                  const std::vector<orb::Keypoint>& second) const {
    const std::vector<orb::Keypoint> first = {{100, 50, 0, 0, octave}};
    const cv::Matx33d homography(zoom, 0, 0, 0, zoom, 0, 0, 0, 1);
    return FindAgain(first, second, homography, octave_scales_).second;
  }

  const std::vector<double> octave_scales_ = orb::OctaveScales(8, 1.2);
};

TEST_F(FindAgainTest, FindsTheNearestWithinTwoPixels) {
  const orb::Keypoint near{100.5F, 50, 0, 0, 0};
  const orb::Keypoint nearer{100, 49.75F, 0, 0, 0};
  EXPECT_THAT(Find(0, 1, {near, nearer}), ElementsAre(nearer));
  EXPECT_THAT(Find(0, 1, {nearer, near}), ElementsAre(nearer));
  EXPECT_THAT(Find(0, 1, {{101.9F, 50, 0, 0, 0}}), testing::SizeIs(1));
  EXPECT_THAT(Find(0, 1, {{102.1F, 50, 0, 0, 0}}), IsEmpty());
  EXPECT_THAT(Find(0, 1, {}), IsEmpty());
}

TEST_F(FindAgainTest, DistancesAreInPixelsOfTheLevel) {
  EXPECT_THAT(Find(4, 1, {{104, 50, 0, 0, 4}}), testing::SizeIs(1)) << "1.2^4 is 2.07";
  EXPECT_THAT(Find(4, 1, {{104.3F, 50, 0, 0, 4}}), IsEmpty());
}

TEST_F(FindAgainTest, FindsKeypointsWithinOneLevelOfTheExpectedScale) {
  for (int octave = 0; octave < 8; ++octave) {
    const auto found = Find(3, 1.2, {{120, 60, 0, 0, octave}});
    EXPECT_EQ(found.size(), octave >= 3 && octave <= 5 ? 1U : 0U) << "octave " << octave;
  }
}

TEST_F(FindAgainTest, SkipsKeypointsFinerThanTheFinestLevel) {
  EXPECT_THAT(Find(0, 0.5, {{50, 25, 0, 0, 0}}), IsEmpty()) << "finer than the finest level";
}

TEST(TrainingPairSamplerTest, PairsMostlyLookAlike) {
  const cv::Mat image = SmoothImage(2, 320, 240);
  const TrainingPairs pairs = TrainingPairSampler({}).Sample(image, 1);
  ASSERT_GT(pairs.first.size(), 50U);
  ASSERT_EQ(pairs.first.size(), pairs.second.size());
  constexpr int kLeft = 13 * 27;  // Leftmost position of the middle row.
  constexpr int kRight = kLeft + 26;
  int num_agreeing = 0;
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    num_agreeing += (pairs.first[i][kLeft] < pairs.first[i][kRight]) ==
                    (pairs.second[i][kLeft] < pairs.second[i][kRight]);
  }
  EXPECT_GT(num_agreeing, 0.65 * static_cast<double>(pairs.first.size()));
}

}  // namespace
}  // namespace corvo::test
