// SPDX-License-Identifier: MIT
#include "vo/offline/ground_height.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace corvo {
namespace {

constexpr double kHeight = 0.11;  // In units.
constexpr int kFrames = 600;
constexpr double kStep = 0.05;

/// A drive straight ahead whose scale drifts: the height is kHeight * exp(drift * share of path).
struct Drive {
  explicit Drive(double drift_of_scale = 0) : drift(drift_of_scale) {
    for (int i = 0; i < kFrames; ++i) {
      FrameResult frame;
      frame.index = i;
      frame.segment = 0;
      frame.world_from_camera = SE3(SO3(), {0, 0, kStep * i});
      trajectory.frames.push_back(frame);
    }
  }

  double Height(double along) const { return kHeight * std::exp(drift * along / kStep / kFrames); }

  /// Adds points of the ground, which rises to the right by `slope`, with errors of 2% in height.
  void AddGround(int count, double slope = 0) {
    std::normal_distribution<double> error(0, 0.02);
    for (int i = 0; i < count; ++i) {
      const double along = Uniform(0, kStep * kFrames), right = Uniform(-2, 2) * kHeight;
      points.emplace_back(right, Height(along) * (1 + error(random)) - slope * right, along);
    }
  }

  /// Adds points anywhere around the path, such as those of houses and vehicles.
  void AddClutter(int count) {
    for (int i = 0; i < count; ++i) {
      points.emplace_back(Uniform(-0.5, 0.5), Uniform(-0.5, 0.12), Uniform(0, kStep * kFrames));
    }
  }

  double Uniform(double min, double max) {
    return std::uniform_real_distribution<double>(min, max)(random);
  }

  std::optional<GroundHeight> Find() const {
    const CameraPath path(trajectory, 0);
    std::vector<PassedPoint> passed;
    for (const Eigen::Vector3d& point : points) passed.push_back(path.Pass(point));
    return FindGround(path, passed);
  }

  double drift;
  std::mt19937 random;
  Trajectory trajectory;
  std::vector<Eigen::Vector3d> points;
};

TEST(GroundHeightTest, IsFoundAmongOtherPoints) {
  Drive drive;
  drive.AddGround(300);
  drive.AddClutter(1500);
  const auto ground = drive.Find();
  ASSERT_TRUE(ground);
  ASSERT_EQ(ground->places.size(), kFrames);
  for (const GroundHeight::AtPlace& place : ground->places) {
    EXPECT_NEAR(place.log_height, std::log(kHeight), 4 * place.sigma);
    EXPECT_LT(place.sigma, 0.01);
  }
}

TEST(GroundHeightTest, FollowsADriftOfTheScale) {
  Drive drive(0.1);
  drive.AddGround(1000);
  const auto ground = drive.Find();
  ASSERT_TRUE(ground);
  for (int i = 0; i < kFrames; i += 50) {
    EXPECT_NEAR(ground->places[i].log_height, std::log(drive.Height(kStep * i)),
                3 * ground->places[i].sigma);
  }
  EXPECT_GT(ground->places.back().log_height - ground->places.front().log_height, 0.06);
}

TEST(GroundHeightTest, FewerPointsAreLessCertain) {
  Drive many, few;
  many.AddGround(1000);
  few.AddGround(100);
  EXPECT_GT(few.Find()->places[300].sigma, 1.2 * many.Find()->places[300].sigma);
}

TEST(GroundHeightTest, ARollOfTheCameraIsFound) {
  Drive drive;
  drive.AddGround(500, std::tan(3 * M_PI / 180));
  const auto ground = drive.Find();
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->roll, 3 * M_PI / 180, 1e-9);
  EXPECT_NEAR(ground->places[300].log_height, std::log(kHeight * std::cos(ground->roll)), 0.01);
}

TEST(GroundHeightTest, ThereIsNoneInASceneWithoutAGround) {
  Drive drive;
  drive.AddClutter(3000);
  EXPECT_FALSE(drive.Find());
  EXPECT_FALSE(Drive().Find());
}

}  // namespace
}  // namespace corvo
