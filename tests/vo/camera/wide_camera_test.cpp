// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/calib3d.hpp>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/random.h"
#include "vo/camera/camera.h"
#include "vo/camera/projection.h"

namespace corvo {
namespace {

using test::IsMatrixNear;
using test::ThrowsError;

CameraParameters Square(CameraModel model) {
  CameraParameters parameters;
  parameters.model = model;
  parameters.width = 512;
  parameters.height = 512;
  parameters.fx = 190;
  parameters.fy = 200;
  parameters.cx = 255;
  parameters.cy = 257;
  return parameters;
}

CameraParameters Kb4(double k1, double k2, double k3, double k4) {
  CameraParameters parameters = Square(CameraModel::kKb4);
  parameters.k1 = k1;
  parameters.k2 = k2;
  parameters.k3 = k3;
  parameters.k4 = k4;
  return parameters;
}

CameraParameters Fov(double omega) {
  CameraParameters parameters = Square(CameraModel::kFov);
  parameters.omega = omega;
  return parameters;
}

/// Returns three kb4 cameras (the TUM-VI fisheye, an invented one, and one whose polynomial turns
/// over inside the image) and three fov cameras (the TUM-mono lens and two invented ones).
std::vector<Camera> WideCameras() {
  return {Camera(Kb4(0.0034823894022493434, 0.0007150348452162257, -0.0020532361418706202,
                     0.00020293673591811182)),
          Camera(Kb4(-0.02, 0.03, -0.01, 0.002)),
          Camera(Kb4(-0.3, 0, 0, 0)),
          Camera(Fov(0.897966326944875)),
          Camera(Fov(0.02)),
          Camera(Fov(1.9))};
}

/// Returns a random ray inside the camera's domain, uniform in the angle from the axis.
Eigen::Vector2d RandomRay(const Camera& camera, test::Random& random) {
  const double angle = random.Uniform(0, 0.999) * std::atan(camera.max_radius());
  const double direction = random.Uniform(0, 2 * std::numbers::pi);
  return std::tan(angle) * Eigen::Vector2d(std::cos(direction), std::sin(direction));
}

TEST(Kb4CameraTest, AgreesWithOpenCv) {
  test::Random random(1);
  for (const Camera& camera : WideCameras()) {
    const CameraParameters& p = camera.parameters();
    if (p.model != CameraModel::kKb4) continue;
    const cv::Matx33d matrix(p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1);
    const cv::Vec4d distortion(p.k1, p.k2, p.k3, p.k4);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d point =
          random.Uniform(0.5, 3) * RandomRay(camera, random).homogeneous();
      std::vector<cv::Point2d> expected;
      cv::fisheye::projectPoints(std::vector<cv::Point3d>{{point.x(), point.y(), point.z()}},
                                 expected, cv::Vec3d(), cv::Vec3d(), matrix, distortion);
      EXPECT_THAT(*camera.Project(point),
                  IsMatrixNear(Eigen::Vector2d(expected[0].x, expected[0].y), 1e-9));
    }
  }
}

TEST(Kb4CameraTest, WithoutCoefficientsPixelsAreProportionalToTheAngle) {
  const Camera camera(Kb4(0, 0, 0, 0));
  for (const double angle : {0.0, 0.3, 1.0, 1.3}) {
    EXPECT_THAT(*camera.Project({std::sin(angle), 0, std::cos(angle)}),
                IsMatrixNear(Eigen::Vector2d(255 + 190 * angle, 257), 1e-10));
  }
}

TEST(FovCameraTest, ProjectionMatchesHandComputedValues) {
  // omega = pi/2: tan(omega/2) = 1. At r = sqrt(3)/2, atan(2 r) = pi/3, so r_d = 2/3.
  const Camera camera(Fov(std::numbers::pi / 2));
  EXPECT_THAT(*camera.Project({0.5 * std::sqrt(3.0), 0, 1}),
              IsMatrixNear(Eigen::Vector2d(255 + 190 * 2.0 / 3, 257), 1e-12));
  // At r = 1/2, along both axes: atan(1) = pi/4, so r_d = 1/2.
  EXPECT_THAT(*camera.Project({0.3, -0.4, 1}),
              IsMatrixNear(Eigen::Vector2d(255 + 190 * 0.3, 257 - 200 * 0.4), 1e-12));
}

TEST(FovCameraTest, TendsToThePinholeAsOmegaTendsToZero) {
  test::Random random(2);
  const Camera none(Fov(0)), pinhole(Square(CameraModel::kPinhole));
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d ray(random.Uniform(-2, 2), random.Uniform(-2, 2));
    const Eigen::Vector2d pixel = *pinhole.Project(ray.homogeneous());
    EXPECT_EQ(*none.Project(ray.homogeneous()), pixel);
    const double smallest = std::numeric_limits<double>::denorm_min();
    for (const double omega : {1e-5, 1e-9, 1e-300, smallest}) {
      const Camera camera(Fov(omega));
      EXPECT_THAT(*camera.Project(ray.homogeneous()), IsMatrixNear(pixel, 1e-6));
      EXPECT_THAT(*camera.Undistort(pixel), IsMatrixNear(ray, 1e-8));
      EXPECT_NEAR(camera.FocalAt(ray), none.FocalAt(ray), 1e-6);
    }
  }
}

TEST(WideCameraTest, UndistortInvertsProject) {
  test::Random random(3);
  for (const Camera& camera : WideCameras()) {
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector2d ray = RandomRay(camera, random);
      const auto pixel = camera.Project(ray.homogeneous());
      ASSERT_TRUE(pixel) << ray.transpose();
      const auto back = camera.Undistort(*pixel);
      ASSERT_TRUE(back) << ray.transpose();
      // Pixels are exact to 1e-13 px, which is a larger ray error where the model flattens.
      EXPECT_THAT(*back, IsMatrixNear(ray, 1e-10 / std::min(1.0, camera.FocalAt(ray) / 100)));
    }
  }
}

TEST(WideCameraTest, EveryRayOfAPixelProjectsBackToIt) {
  for (const Camera& camera : WideCameras()) {
    int num_met = 0;
    for (int y = 0; y < 512; y += 7) {
      for (int x = 0; x < 512; x += 7) {
        const auto ray = camera.Undistort(Eigen::Vector2d(x, y));
        if (!ray) continue;
        ++num_met;
        EXPECT_LT(ray->norm(), camera.max_radius());
        EXPECT_THAT(*camera.Project(ray->homogeneous()), IsMatrixNear(Eigen::Vector2d(x, y), 1e-8));
      }
    }
    EXPECT_GT(num_met, 1000) << camera.parameters().k1;
  }
}

TEST(WideCameraTest, TumViFisheyeCoversAllButTheCorners) {
  const Camera camera = WideCameras().front();
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(0, 257), {511, 257}, {255, 0}, {255, 511}, {90, 60}}) {
    EXPECT_TRUE(camera.Undistort(pixel)) << pixel.transpose();
  }
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(0, 0), {511, 0}, {0, 511}, {511, 511}}) {
    EXPECT_FALSE(camera.Undistort(pixel)) << pixel.transpose();
  }
}

TEST(WideCameraTest, JacobianMatchesTheNumericDerivative) {
  test::Random random(4);
  for (const Camera& camera : WideCameras()) {
    for (int i = 0; i < 100; ++i) {
      // Closer to the end of the domain, the numeric derivative would step outside.
      const Eigen::Vector3d point = 3 * (0.98 * RandomRay(camera, random)).homogeneous();
      Camera::Jacobian analytic;
      ASSERT_TRUE(camera.Project(point, &analytic));
      const Camera::Jacobian numeric = test::NumericJacobianAt<2, 3>(
          point, [&](const Eigen::Vector3d& moved) { return *camera.Project(moved); });
      EXPECT_THAT(analytic, IsMatrixNear(numeric, 1e-6)) << point.transpose();
    }
  }
}

TEST(WideCameraTest, JacobianOnTheAxisIsTheScaleOfTheModel) {
  Camera::Jacobian jacobian;
  EXPECT_EQ(Camera(Kb4(0.1, 0, 0, 0)).Project({0, 0, 2}, &jacobian), Eigen::Vector2d(255, 257));
  EXPECT_THAT(jacobian,
              IsMatrixNear((Camera::Jacobian() << 95, 0, 0, 0, 100, 0).finished(), 1e-12));
  const double stretch = 2 * std::tan(0.45) / 0.9;
  EXPECT_EQ(Camera(Fov(0.9)).Project({0, 0, 2}, &jacobian), Eigen::Vector2d(255, 257));
  EXPECT_THAT(
      jacobian,
      IsMatrixNear((Camera::Jacobian() << 95 * stretch, 0, 0, 0, 100 * stretch, 0).finished(),
                   1e-12));
  EXPECT_EQ(Camera(Fov(0.9)).Undistort({255, 257}), Eigen::Vector2d(0, 0));
  EXPECT_EQ(Camera(Kb4(0.1, 0, 0, 0)).Undistort({255, 257}), Eigen::Vector2d(0, 0));
}

TEST(WideCameraTest, DomainEndsAtEightyDegrees) {
  for (const Camera& camera : {Camera(Kb4(0, 0, 0, 0)), Camera(Fov(0.9))}) {
    EXPECT_DOUBLE_EQ(camera.max_radius(), std::tan(80 * std::numbers::pi / 180));
    EXPECT_TRUE(camera.Project({5.67, 0, 1}));
    EXPECT_FALSE(camera.Project({5.68, 0, 1}));
    const double last = camera.Project({5.67, 0, 1})->x();
    EXPECT_TRUE(camera.Undistort({last, 257}));
    EXPECT_FALSE(camera.Undistort({last + 2, 257}));
    EXPECT_FALSE(camera.Project({0, 0, -1}));
    EXPECT_FALSE(camera.Project({0, 0, std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_FALSE(camera.Undistort({std::numeric_limits<double>::infinity(), 0}));
  }
}

TEST(WideCameraTest, DomainEndsWhereThePolynomialTurnsOver) {
  // (theta - 0.3 theta³)' = 0 at theta² = 1/0.9.
  const double end = std::sqrt(1 / 0.9);
  EXPECT_NEAR(Camera(Kb4(-0.3, 0, 0, 0)).max_radius(), std::tan(end), 1e-12);
  EXPECT_FALSE(Camera(Kb4(-0.3, 0, 0, 0)).Undistort({255 + 190 * (2.0 / 3 * end + 1e-3), 257}));
  EXPECT_TRUE(Camera(Kb4(-0.3, 0, 0, 0)).Undistort({255 + 190 * (2.0 / 3 * end - 1e-3), 257}));
  // A dip beyond which the polynomial grows again still ends the domain:
  // (theta - theta³ + 0.3 theta⁵)' = 1 - 3 s + 1.5 s² = 0 at s = 1 - sqrt(1/3).
  EXPECT_NEAR(Camera(Kb4(-1, 0.3, 0, 0)).max_radius(), std::tan(std::sqrt(1 - std::sqrt(1.0 / 3))),
              1e-12);
  // A slope that stays positive does not limit the domain: 1 - 3 s + 2.5 s².
  EXPECT_DOUBLE_EQ(Camera(Kb4(-1, 0.5, 0, 0)).max_radius(), std::tan(kMaxAngle));
}

TEST(WideCameraTest, DistortedRadiusGrowsInsideTheDomain) {
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Camera camera(Kb4(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                            random.Uniform(-1, 1)));
    double last = -1;
    for (int step = 0; step < 100; ++step) {
      const double angle = 0.01 * step * std::atan(camera.max_radius());
      const double x = camera.Project({std::tan(angle), 0, 1})->x();
      EXPECT_GT(x, last) << i;
      last = x;
    }
  }
}

TEST(WideCameraTest, FocalAtRelatesPixelNoiseToRayNoise) {
  const CameraParameters pinhole = Square(CameraModel::kPinhole);
  EXPECT_EQ(Camera(pinhole).FocalAt({0.4, -3}), Camera(pinhole).focal());
  // kb4 without coefficients at angle t from the axis: dr/dt = 1/cos² along the radius, r/t across.
  CameraParameters parameters = Kb4(0, 0, 0, 0);
  parameters.fy = parameters.fx;
  const double angle = 1.2, across = std::tan(angle) / angle;
  const double along = 1 / (std::cos(angle) * std::cos(angle));
  EXPECT_NEAR(Camera(parameters).FocalAt({std::tan(angle), 0}),
              190 / std::sqrt(0.5 * (along * along + across * across)), 1e-10);
  EXPECT_NEAR(Camera(parameters).FocalAt({0, 0}), 190, 1e-10);
}

TEST(WideCameraTest, FocalAtIsPositiveWhereTheDistortedRadiusEnds) {
  // With k1 = -1/3 the radius t - t³/3 of kb4 ends at t = 1, where its slope 1 - t² is exactly 0.
  const Camera camera(Kb4(-1.0 / 3, 0, 0, 0));
  ASSERT_NEAR(camera.max_radius(), std::tan(1.0), 1e-12);
  for (const double radius : {std::tan(1.0), camera.max_radius()}) {
    for (const Eigen::Vector2d& ray : {Eigen::Vector2d(radius, 0), Eigen::Vector2d(0, radius)}) {
      EXPECT_GE(camera.FocalAt(ray), 1e-6 * camera.fx());
      EXPECT_LE(camera.FocalAt(ray), 1e-5 * camera.fx());
    }
  }
}

TEST(CameraModelTest, NamesRoundTrip) {
  for (const CameraModel model : {CameraModel::kPinhole, CameraModel::kKb4, CameraModel::kFov}) {
    EXPECT_EQ(ParseCameraModel(ToString(model)), model);
  }
  EXPECT_EQ(ParseCameraModel("pinhole"), CameraModel::kPinhole);
  EXPECT_THAT([] { ParseCameraModel("fisheye"); },
              ThrowsError("\"fisheye\"", "pinhole-radtan, kb4 or fov"));
}

TEST(CameraModelTest, ParametersOfOtherModelsAreErrors) {
  CameraParameters kb4 = Kb4(0.1, 0, 0, 0);
  kb4.p1 = 0.25;
  EXPECT_THAT([&] { Camera{kb4}; }, ThrowsError("camera.p1 is 0.25", "kb4"));
  CameraParameters fov = Fov(0.9);
  fov.k3 = -1;
  EXPECT_THAT([&] { Camera{fov}; }, ThrowsError("camera.k3 is -1", "fov"));
  CameraParameters pinhole = Square(CameraModel::kPinhole);
  pinhole.k4 = 1;
  EXPECT_THAT([&] { Camera{pinhole}; }, ThrowsError("camera.k4 is 1", "pinhole-radtan"));
  EXPECT_THAT([] { Camera{Fov(-0.1)}; }, ThrowsError("camera.omega is -0.1", "0 to 3"));
}

}  // namespace
}  // namespace corvo
