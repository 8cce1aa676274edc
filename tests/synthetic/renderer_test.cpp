// SPDX-License-Identifier: MIT
#include "apps/synthetic/renderer.h"

#include <utility>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/matchers.h"

namespace corvo::synthetic {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::IsMatrixNear;

CameraParameters Parameters(bool distorted) {
  CameraParameters parameters;
  parameters.width = 320;
  parameters.height = 240;
  parameters.fx = 260;
  parameters.fy = 255;
  parameters.cx = 155.3;
  parameters.cy = 122.1;
  if (distorted) {
    parameters.k1 = -0.28;
    parameters.k2 = 0.07;
    parameters.p1 = 2e-4;
    parameters.p2 = -3e-4;
  }
  return parameters;
}

/// Returns a square of one gray level, centered at `center`, that faces a camera with identity
/// pose. Its texture is added to `scene`.
Quad FacingQuad(const Vector3d& center, double side, int gray, Scene* scene) {
  Quad quad;
  quad.right = Vector3d::UnitX();
  quad.down = Vector3d::UnitY();
  quad.width = quad.height = side;
  quad.corner = center - Vector3d(side / 2, side / 2, 0);
  quad.texture = scene->AddTexture(Canvas(2, static_cast<std::uint8_t>(gray)));
  return quad;
}

/// Renders one bright spot at `point`, 3 px across.
cv::Mat RenderSpot(const Camera& camera, const Vector3d& point, const SE3& scene_from_camera) {
  Scene scene;
  scene.background = 0;
  scene.quads.push_back(FacingQuad(point, 0.012 * point.z(), 250, &scene));
  return Renderer(camera).Render(scene, scene_from_camera);
}

Vector2d BrightCentroid(const cv::Mat& image) {
  const cv::Moments moments = cv::moments(image);
  return Vector2d(moments.m10 / moments.m00, moments.m01 / moments.m00);
}

class RendererWithAndWithoutDistortion : public ::testing::TestWithParam<bool> {};

/// Exact ground truth depends on this: points appear where Camera::Project places them.
TEST_P(RendererWithAndWithoutDistortion, RendersAPointWhereItProjects) {
  const Camera camera(Parameters(GetParam()));
  for (const Vector3d& point : {Vector3d(0, 0, 2), Vector3d(-0.7, 0.4, 2), Vector3d(0.8, -0.6, 1.9),
                                Vector3d(0.31, 0.63, 1.7), Vector3d(2.3, 1.9, 6)}) {
    const cv::Mat image = RenderSpot(camera, point, SE3());
    EXPECT_THAT(BrightCentroid(image), IsMatrixNear(*camera.Project(point), 0.04));
  }
}

TEST_P(RendererWithAndWithoutDistortion, DepthIsMeasuredAlongTheOpticalAxis) {
  const Camera camera(Parameters(GetParam()));
  Scene scene;
  Quad slanted = FacingQuad(Vector3d(0, 0, 3), 20, 100, &scene);
  slanted.right = Vector3d(0.8, 0, 0.6);
  slanted.corner = Vector3d(0, 0, 3) - 10 * slanted.right - 10 * slanted.down;
  scene.quads.push_back(slanted);
  const cv::Mat depth = Renderer(camera).RenderDepth(scene, SE3());
  for (const cv::Point& pixel : {cv::Point(0, 0), cv::Point(160, 120), cv::Point(200, 239)}) {
    const Vector2d ray = *camera.Undistort(Vector2d(pixel.x, pixel.y));
    EXPECT_NEAR(depth.at<float>(pixel), 3 / (1 - 0.75 * ray.x()), 1e-4) << pixel;
  }
}

INSTANTIATE_TEST_SUITE_P(Renderer, RendererWithAndWithoutDistortion, ::testing::Bool());

TEST(Renderer, RendersTheSceneFromTheGivenPose) {
  const Camera camera(Parameters(false));
  SE3::Tangent tangent;
  tangent << 0.4, -0.2, 0.3, 0.1, -0.2, 0.15;
  const SE3 scene_from_camera = SE3::Exp(tangent);
  const Vector3d point(0.2, 0.3, 3);
  const cv::Mat image = RenderSpot(camera, point, scene_from_camera);
  EXPECT_THAT(BrightCentroid(image),
              IsMatrixNear(*camera.Project(scene_from_camera.Inverse() * point), 0.05));
}

TEST(Renderer, EdgePixelsAreBlendedByCoveredArea) {
  const Camera camera(Parameters(false));
  Scene scene;
  scene.background = 0;
  scene.quads.push_back(FacingQuad(Vector3d(0.01, 0.02, 2), 0.4, 200, &scene));
  const cv::Mat image = Renderer(camera).Render(scene, SE3());
  const double area = 0.2 * camera.fx() * 0.2 * camera.fy();
  EXPECT_NEAR(cv::sum(image)[0] / 200, area, 0.01 * area);
}

TEST(Renderer, ShowsTheNearerSurface) {
  Scene scene;
  scene.quads.push_back(FacingQuad(Vector3d(0, 0, 2), 1, 50, &scene));
  scene.quads.push_back(FacingQuad(Vector3d(0, 0, 1), 0.2, 200, &scene));
  scene.quads.push_back(FacingQuad(Vector3d(0, 0, 3), 9, 100, &scene));
  const cv::Mat image = Renderer(Camera(Parameters(false))).Render(scene, SE3());
  EXPECT_EQ(image.at<std::uint8_t>(122, 155), 200);
  EXPECT_EQ(image.at<std::uint8_t>(122, 205), 50);
  EXPECT_EQ(image.at<std::uint8_t>(10, 10), 100);
}

TEST(Renderer, ShowsNeitherBackFacesNorSurfacesBehindTheCamera) {
  Scene scene;
  scene.background = 7;
  Quad back = FacingQuad(Vector3d(0, 0, 2), 9, 200, &scene);
  std::swap(back.right, back.down);
  scene.quads.push_back(back);
  scene.quads.push_back(FacingQuad(Vector3d(0, 0, -2), 9, 200, &scene));
  const cv::Mat image = Renderer(Camera(Parameters(false))).Render(scene, SE3());
  EXPECT_EQ(cv::countNonZero(image != 7), 0);
}

TEST(Renderer, IsBlackWhereTheCameraHasNoRay) {
  CameraParameters parameters = Parameters(false);
  parameters.k1 = -0.9;
  const Camera camera(parameters);
  ASSERT_FALSE(camera.Undistort({0, 0}).has_value());
  const cv::Mat image = Renderer(camera).Render(Scene(), SE3());
  EXPECT_EQ(image.at<std::uint8_t>(0, 0), 0);
  EXPECT_EQ(image.at<std::uint8_t>(122, 155), 230);
}

}  // namespace
}  // namespace corvo::synthetic
