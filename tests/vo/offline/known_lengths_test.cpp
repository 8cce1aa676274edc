// SPDX-License-Identifier: MIT
#include "vo/offline/known_lengths.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo {
namespace {

using test::ThrowsError;

/// Returns frames half a unit apart along x that look along z: the first three of segment 0, the
/// others of segment 1.
Trajectory FramesAlongX() {
  Trajectory trajectory;
  for (int i = 0; i < 6; ++i) {
    FrameResult frame;
    frame.index = i;
    frame.segment = i / 3;
    frame.world_from_camera = SE3(SO3::Exp({0, 0.01 * i, 0}), {0.5 * i, 0, 0});
    trajectory.frames.push_back(frame);
  }
  return trajectory;
}

Camera Vga() {
  CameraParameters parameters;
  parameters.width = 640;
  parameters.height = 480;
  parameters.fx = parameters.fy = 500;
  parameters.cx = 320;
  parameters.cy = 240;
  parameters.k1 = -0.1;
  return Camera(parameters);
}

const Eigen::Vector3d kTop(0.6, -0.5, 4), kBottom(0.5, 0.9, 4.5);

/// Returns the ends kTop and kBottom as frames show them.
KnownSize SizeInFrames(const std::vector<int>& frames, double meters) {
  KnownSize known;
  known.meters = meters;
  for (const int i : frames) {
    const SE3 camera_from_world = FramesAlongX().frames[i].world_from_camera->Inverse();
    known.views.push_back(
        {i, *Vga().Project(camera_from_world * kTop), *Vga().Project(camera_from_world * kBottom)});
  }
  return known;
}

TEST(KnownDistanceTest, MeasuresTheScaleInTheMiddleOfTheFrames) {
  const ScaleMeasurement measured = MeasureScale(FramesAlongX(), KnownDistance{3, 4, 5});
  EXPECT_EQ(measured.segment, 1);
  EXPECT_EQ(measured.frame, 3.5);
  EXPECT_DOUBLE_EQ(measured.scale.meters_per_unit, 10);
  EXPECT_EQ(measured.scale.log_sigma, 0);
}

TEST(KnownDistanceTest, RejectsDistancesThatDetermineNoScale) {
  Trajectory units = FramesAlongX();
  units.frames[1].world_from_camera.reset();
  units.frames[4].world_from_camera = units.frames[3].world_from_camera;
  const auto error = [&](int first, int second, double meters, const char* message) {
    EXPECT_THAT(
        [&] {
          MeasureScale(units, KnownDistance{first, second, meters});
        },
        ThrowsError("known distance", message));
  };
  error(0, 1, 5, "frame 1 has no pose");
  error(0, 6, 5, "frame 6 is not one of 0 to 5");
  error(-1, 0, 5, "frame -1 is not one of 0 to 5");
  error(0, 3, 5, "different segments");
  error(3, 4, 5, "did not move");
  error(0, 2, std::nan(""), "nan");
  error(0, 2, 0, "0");
}

TEST(KnownSizeTest, MeasuresTheScaleFromTwoOrMoreViews) {
  const double units = (kTop - kBottom).norm();
  for (const std::vector<int>& frames : {std::vector<int>{0, 2}, {2, 1}, {0, 1, 2}}) {
    const ScaleMeasurement measured =
        MeasureScale(FramesAlongX(), Vga(), SizeInFrames(frames, 3 * units));
    EXPECT_EQ(measured.segment, 0);
    EXPECT_EQ(measured.frame, 0.5 * (frames.front() + frames.back()));
    EXPECT_NEAR(measured.scale.meters_per_unit, 3, 1e-9);
  }
}

TEST(KnownSizeTest, ItsStandardDeviationIsThatOfTheErrors) {
  test::Random random(1);
  const KnownSize exact = SizeInFrames({0, 1, 2}, 1);
  const double truth = MeasureScale(FramesAlongX(), Vga(), exact).scale.meters_per_unit;
  constexpr int kRuns = 1000;
  double squared = 0;
  for (int run = 0; run < kRuns; ++run) {
    KnownSize noisy = exact;
    noisy.pixel_sigma = 2;
    for (ObjectView& view : noisy.views) {
      view.first_end_px += Eigen::Vector2d{random.Gaussian(2), random.Gaussian(2)};
      view.second_end_px += Eigen::Vector2d{random.Gaussian(2), random.Gaussian(2)};
    }
    const FrameScale scale = MeasureScale(FramesAlongX(), Vga(), noisy).scale;
    squared += std::pow(std::log(scale.meters_per_unit / truth) / scale.log_sigma, 2);
  }
  EXPECT_NEAR(squared / kRuns, 1, 0.15);
}

TEST(KnownSizeTest, RejectsViewsThatDetermineNoScale) {
  const auto error = [](const KnownSize& known, const char* message) {
    EXPECT_THAT([&] { MeasureScale(FramesAlongX(), Vga(), known); },
                ThrowsError("known size", message));
  };
  error(SizeInFrames({0}, 1), "at least two views");
  error(SizeInFrames({0, 0}, 1), "do not meet");
  error(SizeInFrames({0, 3}, 1), "different segments");
  error(SizeInFrames({0, 2}, 0), "0");
  error(SizeInFrames({0, 2}, std::nan("")), "nan");
  KnownSize known = SizeInFrames({0, 2}, 1);
  known.views[1].frame = 7;
  error(known, "frame 7 is not one of 0 to 5");
  known = SizeInFrames({0, 2}, 1);
  known.views[0].first_end_px.x() = 640;
  error(known, "(640, ");
  known.views[0].first_end_px.x() = std::nan("");
  error(known, "nan");
  known = SizeInFrames({0, 2}, 1);
  known.views[1].second_end_px.y() += 60;
  error(known, "do not agree");
  known = SizeInFrames({0, 2}, 1);
  std::swap(known.views[0].first_end_px, known.views[1].first_end_px);
  error(known, "do not meet in front of the camera");
  known = SizeInFrames({0, 2}, 1);
  known.pixel_sigma = 1000;
  error(known, "too poorly");
  known.pixel_sigma = std::nan("");
  error(known, "nan");
  known = SizeInFrames({0, 2}, 1);
  for (ObjectView& view : known.views) view.second_end_px = view.first_end_px;
  error(known, "too poorly");
}

}  // namespace
}  // namespace corvo
