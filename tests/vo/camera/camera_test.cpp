// SPDX-License-Identifier: MIT
#include "vo/camera/camera.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/random.h"

namespace corvo {
namespace {

using test::IsMatrixNear;
using test::ThrowsError;

CameraParameters Pinhole() {
  CameraParameters parameters;
  parameters.width = 640;
  parameters.height = 480;
  parameters.fx = 500;
  parameters.fy = 510;
  parameters.cx = 320;
  parameters.cy = 240;
  return parameters;
}

CameraParameters WithDistortion(double k1, double k2, double p1, double p2, double k3) {
  CameraParameters parameters = Pinhole();
  parameters.k1 = k1;
  parameters.k2 = k2;
  parameters.p1 = p1;
  parameters.p2 = p2;
  parameters.k3 = k3;
  return parameters;
}

/// Returns cameras without distortion, with barrel and pincushion distortion, with a distortion
/// that turns over inside the image, and with two published calibrations.
std::vector<Camera> Cameras() {
  std::vector<Camera> cameras = {Camera(Pinhole()), Camera(WithDistortion(-0.2, 0, 0, 0, 0)),
                                 Camera(WithDistortion(0.3, 0.1, 1e-3, -2e-3, 0.05)),
                                 Camera(WithDistortion(-0.8, 0.1, 1e-3, 0, 0))};
  CameraParameters tum = WithDistortion(0.262383, -0.953104, -0.005358, 0.002628, 1.163314);
  tum.fx = 517.306408;
  tum.fy = 516.469215;
  tum.cx = 318.643040;
  tum.cy = 255.313989;
  cameras.emplace_back(tum);
  CameraParameters euroc = WithDistortion(-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0);
  euroc.width = 752;
  euroc.fx = 458.654;
  euroc.fy = 457.296;
  euroc.cx = 367.215;
  euroc.cy = 248.375;
  cameras.emplace_back(euroc);
  return cameras;
}

std::vector<Eigen::Vector2d> ImageGrid(const Camera& camera) {
  std::vector<Eigen::Vector2d> pixels;
  for (int y = 0; y <= 10; ++y) {
    for (int x = 0; x <= 10; ++x) {
      pixels.emplace_back(0.1 * x * (camera.width() - 1), 0.1 * y * (camera.height() - 1));
    }
  }
  return pixels;
}

TEST(CameraTest, PinholeProjectionMatchesHandComputedValues) {
  const Camera camera(Pinhole());
  EXPECT_EQ(camera.Project({2, -1, 4}), Eigen::Vector2d(570, 112.5));
  EXPECT_EQ(camera.Undistort({570, 112.5}), Eigen::Vector2d(0.5, -0.25));
  EXPECT_EQ(camera.focal(), 505);
  EXPECT_EQ(camera.max_radius(), std::numeric_limits<double>::infinity());
}

TEST(CameraTest, DistortionMatchesHandComputedValues) {
  // a = 0.5, b = 0, r² = 0.25: c = 1 + 0.4/4 + 0.32/16 + 0.64/64 = 1.13;
  // u = 500 (0.565 + 0.03 * 0.75) + 320, v = 510 (0.02 * 0.25) + 240.
  const Camera camera(WithDistortion(0.4, 0.32, 0.02, 0.03, 0.64));
  EXPECT_THAT(*camera.Project({1, 0, 2}), IsMatrixNear(Eigen::Vector2d(613.75, 242.55), 1e-12));
}

TEST(CameraTest, AgreesWithOpenCv) {
  test::Random random(6);
  for (const Camera& camera : Cameras()) {
    const CameraParameters& p = camera.parameters();
    const cv::Matx33d matrix(p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1);
    const cv::Vec<double, 5> distortion(p.k1, p.k2, p.p1, p.p2, p.k3);
    for (int i = 0; i < 50; ++i) {
      const double x = random.Uniform(-1, 1), y = random.Uniform(-1, 1), z = random.Uniform(2, 8);
      std::vector<cv::Point2d> expected;
      cv::projectPoints(std::vector<cv::Point3d>{{x, y, z}}, cv::Vec3d(), cv::Vec3d(), matrix,
                        distortion, expected);
      EXPECT_THAT(*camera.Project({x, y, z}),
                  IsMatrixNear(Eigen::Vector2d(expected[0].x, expected[0].y), 1e-9));
    }
  }
}

TEST(CameraTest, UndistortInvertsProject) {
  test::Random random(7);
  for (const Camera& camera : Cameras()) {
    for (int i = 0; i < 500; ++i) {
      const double radius = random.Uniform(0, std::min(1.2, 0.98 * camera.max_radius()));
      const double angle = random.Uniform(-4, 4);
      const Eigen::Vector2d ray(radius * std::cos(angle), radius * std::sin(angle));
      const auto pixel = camera.Project(ray.homogeneous());
      ASSERT_TRUE(pixel);
      const auto back = camera.Undistort(*pixel);
      ASSERT_TRUE(back) << "radius " << radius << " k1 " << camera.parameters().k1;
      EXPECT_THAT(*back, IsMatrixNear(ray, 1e-12));
    }
  }
}

TEST(CameraTest, EveryRayOfAPixelProjectsBackToIt) {
  for (const Camera& camera : Cameras()) {
    int num_without = 0;
    for (const Eigen::Vector2d& pixel : ImageGrid(camera)) {
      const auto ray = camera.Undistort(pixel);
      if (!ray) {
        ++num_without;
        continue;
      }
      EXPECT_THAT(*camera.Project(5 * ray->homogeneous()), IsMatrixNear(pixel, 1e-9));
    }
    EXPECT_EQ(num_without > 0, camera.parameters().k1 == -0.8) << camera.parameters().k1;
  }
}

TEST(CameraTest, JacobianMatchesTheNumericDerivative) {
  test::Random random(8);
  for (const Camera& camera : Cameras()) {
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d point(random.Uniform(-2, 2), random.Uniform(-2, 2), 5);
      Camera::Jacobian analytic;
      ASSERT_TRUE(camera.Project(point, &analytic));
      const Camera::Jacobian numeric = test::NumericJacobianAt<2, 3>(
          point, [&](const Eigen::Vector3d& moved) { return *camera.Project(moved); });
      EXPECT_THAT(analytic, IsMatrixNear(numeric, 1e-7));
    }
  }
}

TEST(CameraTest, PointsBehindTheCameraHaveNoPixel) {
  const Camera camera(Pinhole());
  EXPECT_FALSE(camera.Project({0, 0, -1}));
  EXPECT_FALSE(camera.Project({0, 0, 0}));
  EXPECT_FALSE(camera.Project({1, 0, 1e-320}));
  EXPECT_FALSE(camera.Project({0, 0, std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(camera.Project({std::numeric_limits<double>::quiet_NaN(), 0, 1}));
}

TEST(CameraTest, NonFinitePixelsHaveNoRay) {
  for (const Camera& camera : Cameras()) {
    EXPECT_FALSE(camera.Undistort({std::numeric_limits<double>::quiet_NaN(), 0}));
    EXPECT_FALSE(camera.Undistort({0, std::numeric_limits<double>::infinity()}));
  }
}

TEST(CameraTest, MaxRadiusIsWhereTheRadialPolynomialTurnsOver) {
  // (r - r³)' = 0 at r² = 1/3.
  EXPECT_NEAR(Camera(WithDistortion(-1, 0, 0, 0, 0)).max_radius(), std::sqrt(1.0 / 3), 1e-14);
  // (r - r⁵)' = 0 at r⁴ = 1/5.
  EXPECT_NEAR(Camera(WithDistortion(0, -1, 0, 0, 0)).max_radius(), std::pow(0.2, 0.25), 1e-14);
  // (r - r⁷)' = 0 at r⁶ = 1/7.
  EXPECT_NEAR(Camera(WithDistortion(0, 0, 0, 0, -1)).max_radius(), std::pow(1.0 / 7, 1.0 / 6),
              1e-14);
  // (r - 2/3 r³ + 1/5 r⁵)' = (1 - r²)² touches 0 at r = 1 but the polynomial never falls.
  EXPECT_GE(Camera(WithDistortion(-2.0 / 3, 0.2, 0, 0, 0)).max_radius(), 1 - 1e-7);
  // A dip beyond which the polynomial grows again still ends the domain:
  // 1 - 3 r² + 3/2 r⁴ = 0.
  EXPECT_NEAR(Camera(WithDistortion(-1, 0.3, 0, 0, 0)).max_radius(),
              std::sqrt(1 - std::sqrt(1.0 / 3)), 1e-14);
  // A slope that dips (to 0.1) but stays positive does not end it.
  EXPECT_TRUE(std::isinf(Camera(WithDistortion(-1, 0.5, 0, 0, 0)).max_radius()));
}

TEST(CameraTest, DistortedRadiusGrowsInsideTheDomainAndFallsBeyond) {
  test::Random random(9);
  for (int i = 0; i < 300; ++i) {
    const Camera camera(
        WithDistortion(random.Uniform(-1, 1), random.Uniform(-1, 1), 0, 0, random.Uniform(-1, 1)));
    const CameraParameters& p = camera.parameters();
    const auto distorted = [&p](double r) {
      return r + p.k1 * std::pow(r, 3) + p.k2 * std::pow(r, 5) + p.k3 * std::pow(r, 7);
    };
    const double end = std::min(camera.max_radius(), 5.0);
    for (int step = 0; step < 100; ++step) {
      EXPECT_LT(distorted(0.01 * step * end), distorted(0.01 * (step + 1) * end));
    }
    if (std::isfinite(camera.max_radius())) {
      EXPECT_GT(distorted(camera.max_radius()), distorted(camera.max_radius() * (1 + 1e-4)));
    }
  }
}

TEST(CameraTest, RaysOutsideTheDomainHaveNoPixel) {
  const Camera camera(WithDistortion(-1, 0, 0, 0, 0));
  EXPECT_TRUE(camera.Project({0.57, 0, 1}));
  EXPECT_FALSE(camera.Project({0.58, 0, 1}));
  EXPECT_TRUE(camera.Undistort({320 + 500 * 0.384, 240}));   // The maximum of r - r³ is
  EXPECT_FALSE(camera.Undistort({320 + 500 * 0.386, 240}));  // 2/3^1.5 = 0.3849.
}

TEST(CameraTest, ContainsIsTrueOnTheAreaOfTheImage) {
  const Camera camera(Pinhole());
  EXPECT_TRUE(camera.Contains({-0.5, -0.5}));
  EXPECT_TRUE(camera.Contains({639.49, 479.49}));
  EXPECT_FALSE(camera.Contains({639.5, 0}));
  EXPECT_FALSE(camera.Contains({0, 479.5}));
  EXPECT_FALSE(camera.Contains({-0.51, 0}));
  EXPECT_FALSE(camera.Contains({std::numeric_limits<double>::quiet_NaN(), 0}));
}

TEST(CameraTest, RejectsParametersOutOfRange) {
  CameraParameters parameters = Pinhole();
  parameters.width = 0;
  EXPECT_THAT([&] { Camera{parameters}; }, ThrowsError("camera.width is 0", "1 to"));
  parameters = Pinhole();
  parameters.fy = -1;
  EXPECT_THAT([&] { Camera{parameters}; }, ThrowsError("camera.fy is -1"));
  parameters = Pinhole();
  parameters.k3 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { Camera{parameters}; }, ThrowsError("camera.k3 is nan"));
}

TEST(CameraTest, MakeReturnsNulloptIfTheConstructorThrows) {
  CameraParameters parameters = Pinhole();
  EXPECT_EQ(Camera::Make(parameters), Camera(parameters));
  parameters.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Camera::Make(parameters), std::nullopt);
  EXPECT_THROW(Camera{parameters}, Error);
  parameters = Pinhole();
  parameters.omega = 0.5;  // Not a parameter of the pinhole model.
  EXPECT_EQ(Camera::Make(parameters), std::nullopt);
  EXPECT_THROW(Camera{parameters}, Error);
}

TEST(CameraTest, ReturnsNoPixelThatIsNotFinite) {
  CameraParameters parameters;
  parameters.width = 640;
  parameters.height = 480;
  parameters.fx = parameters.fy = 1e6;
  const Camera camera(parameters);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Camera::Jacobian jacobian;
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(1e150, 0, 1e-155), Eigen::Vector3d(1e305, 0, 1), Eigen::Vector3d(nan, 0, 1),
        Eigen::Vector3d(0, 0, nan), Eigen::Vector3d(infinity, 0, 1)}) {
    EXPECT_FALSE(camera.Project(point)) << point.transpose();
    EXPECT_FALSE(camera.Project(point, &jacobian)) << point.transpose();
  }
  EXPECT_FALSE(camera.Project({0, 0, 1e-305}, &jacobian));
  EXPECT_FALSE(camera.Undistort({nan, 0}));
  EXPECT_THAT([&] { camera.FocalAt({nan, 0}); }, test::ThrowsError("not finite"));
  parameters.fx = nan;
  EXPECT_THAT([&] { Camera{parameters}; }, test::ThrowsError("camera.fx is nan"));
}

}  // namespace
}  // namespace corvo
