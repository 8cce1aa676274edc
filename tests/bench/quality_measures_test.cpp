// SPDX-License-Identifier: MIT
#include "bench/quality/measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>

namespace corvo::bench {
namespace {

/// A point and its one-byte descriptor.
struct Marked {
  float x = 0;
  float y = 0;
  int mark = 0;
};

DescribedPoints Describe(const std::vector<Marked>& marked) {
  DescribedPoints described;
  described.norm = cv::NORM_HAMMING;
  for (const Marked& point : marked) {
    described.points.emplace_back(cv::Point2f(point.x, point.y), 31.0F);
    described.descriptors.push_back(cv::Mat(1, 1, CV_8U, cv::Scalar(point.mark)));
  }
  return described;
}

/// Measures two images of which the second is the first shifted by (10, 0) px.
Measures MeasureMoved(const std::vector<Marked>& first, const std::vector<Marked>& second) {
  return Measure({Describe(first), Describe(second), cv::Matx33d(1, 0, 10, 0, 1, 0, 0, 0, 1),
                  cv::Size(100, 50), cv::Size(100, 50)});
}

TEST(QualityMeasuresTest, ShiftedImageIsMatchedCompletely) {
  const Measures measures = MeasureMoved({{20, 20, 1}, {40, 20, 2}, {60, 20, 4}},
                                         {{70, 20, 4}, {30, 20, 1}, {50, 20, 2}});
  EXPECT_EQ(measures.first, 3);
  EXPECT_EQ(measures.mutual_correct, 3);
  EXPECT_EQ(measures.Repeatability(), 1);
  EXPECT_EQ(measures.PairedRepeatability(), 1);
  EXPECT_EQ(measures.Precision(), 1);
  EXPECT_EQ(measures.MatchingScore(), 1);
}

TEST(QualityMeasuresTest, ToleranceIsThreePixels) {
  EXPECT_EQ(MeasureMoved({{20, 20, 1}}, {{30, 23, 1}}).nearest_correct, 1);
  EXPECT_EQ(MeasureMoved({{20, 20, 1}}, {{30, 23, 1}}).repeated, 1);
  EXPECT_EQ(MeasureMoved({{20, 20, 1}}, {{30, 23.01F, 1}}).nearest_correct, 0);
  EXPECT_EQ(MeasureMoved({{20, 20, 1}}, {{30, 23.01F, 1}}).repeated, 0);
}

TEST(QualityMeasuresTest, PointsOutsideTheOtherImageDoNotCount) {
  const Measures measures = MeasureMoved({{20, 20, 1}, {95, 20, 2}}, {{30, 20, 1}, {3, 20, 2}});
  EXPECT_EQ(measures.first, 1);
  EXPECT_EQ(measures.fewer, 1);
  EXPECT_EQ(measures.Precision(), 1);
  EXPECT_EQ(measures.mutual, 1);
}

TEST(QualityMeasuresTest, PointsMayBeRepeatedTogetherButArePairedOneToOne) {
  const Measures measures =
      MeasureMoved({{20, 20, 1}, {21, 20, 2}, {60, 20, 4}}, {{30, 20, 1}, {80, 40, 8}, {5, 5, 9}});
  EXPECT_EQ(measures.repeated, 2);
  EXPECT_EQ(measures.paired, 1);
  EXPECT_EQ(measures.fewer, 2) << "(5, 5) maps outside the first image";
}

TEST(QualityMeasuresTest, NearestPointsArePairedFirst) {
  // (20, 20) is near both points of the second image; if pairs were formed in order, it would take
  // the only partner of the other point.
  const Measures measures = MeasureMoved({{20, 20, 1}, {22, 20, 2}}, {{31.5F, 20, 1}, {28, 20, 2}});
  EXPECT_EQ(measures.paired, 2);
}

TEST(QualityMeasuresTest, MatchIsMutualIfItIsTheNearestInBothDirections) {
  // For both points of the first image, the nearest descriptor is that of the first point of the
  // second image; one of them equals it.
  const Measures measures = MeasureMoved({{20, 20, 3}, {60, 20, 1}}, {{70, 20, 1}, {30, 40, 0xf0}});
  EXPECT_EQ(measures.mutual, 1);
  EXPECT_EQ(measures.mutual_correct, 1);
  EXPECT_EQ(measures.nearest_correct, 1);
  EXPECT_EQ(measures.Precision(), 0.5);
}

TEST(QualityMeasuresTest, CountsAddUp) {
  Measures sum = MeasureMoved({{20, 20, 1}}, {{30, 20, 1}});
  sum += MeasureMoved({{20, 20, 1}}, {{60, 20, 1}});
  EXPECT_EQ(sum.images, 2);
  EXPECT_EQ(sum.Precision(), 0.5);
  EXPECT_EQ(sum.Repeatability(), 0.5);
  EXPECT_EQ(sum.PairedRepeatability(), 0.5);
  EXPECT_EQ(sum.MatchingScore(), 0.5);
  EXPECT_EQ(sum.MutualPrecision(), 0.5);
}

TEST(QualityMeasuresTest, SharesOfNothingAreZero) {
  const Measures measures = MeasureMoved({}, {});
  EXPECT_EQ(measures.Precision(), 0);
  EXPECT_EQ(measures.Repeatability(), 0);
  EXPECT_EQ(MeasureMoved({{20, 20, 1}}, {}).mutual, 0);
}

TEST(SpreadTest, IsTheShareOfOccupiedCells) {
  const auto spread = [](const std::vector<Marked>& points) {
    return Spread(Describe(points).points, cv::Size(640, 480));
  };
  EXPECT_EQ(spread({}), 0);
  EXPECT_EQ(spread({{0, 0}, {19, 19}}), 1.0 / 768);
  EXPECT_EQ(spread({{19, 19}, {20, 19}, {20, 20}, {639, 479}}), 4.0 / 768);
}

}  // namespace
}  // namespace corvo::bench
