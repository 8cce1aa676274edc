// SPDX-License-Identifier: MIT
#include "vo/offline/metric_scale.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "tests/support/matchers.h"

namespace corvo {
namespace {

using test::ThrowsError;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Returns frames one unit apart: the first three of segment 0, the others of segment 1.
Trajectory SixFrames() {
  Trajectory trajectory;
  for (int i = 0; i < 6; ++i) {
    FrameResult frame;
    frame.index = i;
    frame.segment = i / 3;
    frame.world_from_camera = SE3(SO3::Exp({0, 0.5, 0}), {1, 2, 1.0 * i});
    frame.relative_pose = {3 * (i / 3), SE3(), SE3::Matrix6::Identity()};
    trajectory.frames.push_back(frame);
  }
  return trajectory;
}

TEST(MetricScaleTest, AConstantScaleMultipliesLengthsAndTheirCovariancesOnly) {
  const Trajectory units = SixFrames();
  const MetricTransform metric(units, ConstantScale(units, 2.5));
  for (int i = 0; i < 6; ++i) {
    const SE3& pose = *units.frames[i].world_from_camera;
    EXPECT_EQ(*metric.Apply(units).frames[i].world_from_camera,
              SE3(pose.rotation(), 2.5 * pose.translation()));
  }
  const RelativePose relative = *metric.Apply(units).frames[2].relative_pose;
  EXPECT_NEAR(relative.reference_from_camera.translation().norm(), 5, 1e-12);
  Eigen::Matrix<double, 6, 1> variances;
  variances << 6.25, 6.25, 6.25, 1, 1, 1;
  EXPECT_EQ(relative.covariance, SE3::Matrix6(variances.asDiagonal()));
  EXPECT_EQ(metric.ToMeters({1, {3, 4, 5}}), Eigen::Vector3d(7.5, 10, 12.5));
  EXPECT_EQ(metric.Apply(units).Segments()[0].scale, SegmentScale());
}

TEST(MetricScaleTest, FramesWithoutAPoseStayWithoutOne) {
  Trajectory units = SixFrames();
  units.frames[1].world_from_camera.reset();
  const MetricTransform metric(units, ConstantScale(units, 2));
  EXPECT_FALSE(metric.Apply(units).frames[1].world_from_camera);
  EXPECT_THAT(metric.MetersPerUnit(), testing::ElementsAre(2, 1, 2, 2, 2, 2));
}

TEST(MetricScaleTest, EachStepHasTheMeanScaleOfItsFrames) {
  const Trajectory units = SixFrames();
  MetricScale scale = ConstantScale(units, 2);
  scale.frames[1]->meters_per_unit = 3;
  scale.frames[2]->meters_per_unit = 4;
  const MetricTransform metric(units, scale);
  const auto position = [&](int i) {
    return metric.Apply(units).frames[i].world_from_camera->translation();
  };
  EXPECT_EQ(position(0), Eigen::Vector3d(2, 4, 0));
  EXPECT_THAT(position(1) - position(0), test::IsDenseNear(Eigen::Vector3d(0, 0, 2.5), 1e-12));
  EXPECT_THAT(position(2) - position(1), test::IsDenseNear(Eigen::Vector3d(0, 0, 3.5), 1e-12));
  EXPECT_EQ(position(3), Eigen::Vector3d(2, 4, 6)) << "a segment of its own";
}

TEST(MetricScaleTest, APointIsScaledAboutTheNearestFrame) {
  const Trajectory units = SixFrames();
  MetricScale scale = ConstantScale(units, 2);
  scale.frames[2]->meters_per_unit = 4;
  const MetricTransform metric(units, scale);
  const Eigen::Vector3d camera = metric.Apply(units).frames[2].world_from_camera->translation();
  EXPECT_THAT(metric.ToMeters({0, {2, 2, 2.5}}) - camera,
              test::IsDenseNear(Eigen::Vector3d(4, 0, 2), 1e-12));
}

TEST(MetricScaleTest, TheErrorOfTheScaleLengthensRelativePoses) {
  const Trajectory units = SixFrames();
  MetricScale scale = ConstantScale(units, 1);
  scale.frames[2]->log_sigma = 0.1;
  const SE3::Matrix6 covariance =
      MetricTransform(units, scale).Apply(units).frames[2].relative_pose->covariance;
  // The frame is 2 m from its reference, in the direction `along` of its own axes.
  const Eigen::Vector3d along = SO3::Exp({0, 0.5, 0}).Inverse() * Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d added = covariance.topLeftCorner<3, 3>() - Eigen::Matrix3d::Identity();
  EXPECT_LT((added - 0.04 * along * along.transpose()).norm(), 1e-12);
  EXPECT_TRUE((covariance.bottomRightCorner<3, 3>().isIdentity()));
}

TEST(MetricScaleTest, AMeasuredScaleIsThatOfItsSegment) {
  const Trajectory units = SixFrames();
  const MetricTransform metric(
      units, InterpolateScale(units, {{0, 1, {2.5, 0}}}, ScaleSource::kKnownDistance));
  EXPECT_THAT(metric.MetersPerUnit(), testing::ElementsAre(2.5, 2.5, 2.5, 1, 1, 1));
  const std::vector<Segment> segments = metric.Apply(units).Segments();
  EXPECT_EQ(segments[0].scale.source, ScaleSource::kKnownDistance);
  EXPECT_EQ(segments[1].scale.source, ScaleSource::kArbitrary);
}

TEST(MetricScaleTest, BetweenMeasurementsItsLogarithmIsLinear) {
  Trajectory units = SixFrames();
  for (FrameResult& frame : units.frames) frame.segment = 0;
  const MetricScale scale =
      InterpolateScale(units, {{0, 4, {8, 0.1}}, {0, 1.5, {0.25, 0.2}}}, ScaleSource::kKnownSize);
  const auto expect = [&](int frame, double meters_per_unit, double log_sigma) {
    EXPECT_NEAR(scale.frames[frame]->meters_per_unit, meters_per_unit, 1e-12) << frame;
    EXPECT_NEAR(scale.frames[frame]->log_sigma, log_sigma, 1e-12) << frame;
  };
  expect(0, 0.25, 0.2);
  expect(1, 0.25, 0.2);
  expect(2, 0.5, std::hypot(0.8 * 0.2, 0.2 * 0.1));
  expect(3, 2, std::hypot(0.4 * 0.2, 0.6 * 0.1));
  expect(4, 8, 0.1);
  expect(5, 8, 0.1);
}

TEST(MetricScaleTest, RejectsTwoMeasurementsOfOneFrame) {
  EXPECT_THAT(
      [] {
        InterpolateScale(SixFrames(), {{0, 1, {2, 0}}, {1, 1, {2, 0}}, {0, 1, {3, 0}}},
                         ScaleSource::kKnownSize);
      },
      ThrowsError("two known lengths", "frame 1"));
}

TEST(MetricScaleTest, RejectsScalesThatAreNotPositive) {
  for (const double value : {0.0, -1.0, kNaN, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT([&] { ConstantScale(SixFrames(), value); }, ThrowsError("meters per unit"));
    EXPECT_THAT([&] { ScaleOfCameraHeight(SixFrames(), {}, value); }, ThrowsError("camera height"));
  }
}

TEST(MetricScaleTest, TheCameraHasItsHeightAboveTheGround) {
  Trajectory units;
  std::vector<PointInSegment> points;
  for (int i = 0; i < 100; ++i) {
    FrameResult frame;
    frame.index = i;
    frame.segment = 0;
    frame.world_from_camera = SE3(SO3(), {0, 0, 0.05 * i});
    units.frames.push_back(frame);
    for (const double right : {-0.1, -0.05, 0.02, 0.07, 0.1}) {
      points.push_back({0, {right, 0.11, 0.05 * i}});
    }
  }
  const MetricTransform metric(units, ScaleOfCameraHeight(units, points, 1.65));
  EXPECT_NEAR(metric.ToMeters({0, {0.05, 0.11, 2}}).y(), 1.65, 0.01);
  const SegmentScale scale = metric.Apply(units).Segments()[0].scale;
  EXPECT_EQ(scale.source, ScaleSource::kCameraHeight);
  EXPECT_GT(*scale.factor, 1);
  EXPECT_LT(*scale.factor, 1.01);
  points.clear();
  EXPECT_FALSE(ScaleOfCameraHeight(units, points, 1.65).frames[0]) << "no ground";
}

}  // namespace
}  // namespace corvo
