// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cstring>

#include <opencv2/imgcodecs.hpp>

#include "apps/export/colmap_camera.h"
#include "apps/export/colmap_model.h"
#include "apps/export/nerfstudio_transforms.h"
#include "apps/export/point_colors.h"
#include "apps/export/point_fit.h"
#include "apps/export/point_selection.h"
#include "apps/export/undistortion.h"
#include "orb/error.h"
#include "tests/support/data.h"
#include "tests/support/point_scene.h"
#include "vo/camera/camera.h"

namespace corvo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

CameraParameters Distorted() {
  CameraParameters camera = test::PinholeCamera().parameters();
  camera.k1 = -0.2;
  camera.k2 = 0.03;
  camera.p1 = 0.001;
  camera.p2 = -0.002;
  return camera;
}

TEST(ColmapCamera, IsTheSimplestModelWithTheSameProjection) {
  CameraParameters camera = test::PinholeCamera().parameters();
  const double cx = camera.cx + 0.5, cy = camera.cy + 0.5;
  EXPECT_EQ(ToColmap(camera).model, "PINHOLE");
  EXPECT_THAT(ToColmap(camera).parameters, ElementsAre(camera.fx, camera.fy, cx, cy));
  camera = Distorted();
  EXPECT_EQ(ToColmap(camera).model, "OPENCV");
  EXPECT_THAT(ToColmap(camera).parameters,
              ElementsAre(camera.fx, camera.fy, cx, cy, -0.2, 0.03, 0.001, -0.002));
  camera.k3 = 0.01;
  EXPECT_EQ(ToColmap(camera).model, "FULL_OPENCV");
  EXPECT_THAT(ToColmap(camera).parameters,
              ElementsAre(camera.fx, camera.fy, cx, cy, -0.2, 0.03, 0.001, -0.002, 0.01, 0, 0, 0));
  camera.model = CameraModel::kKb4;
  EXPECT_EQ(ToColmap(camera).model, "OPENCV_FISHEYE");
  camera.model = CameraModel::kFov;
  EXPECT_EQ(ToColmap(camera).model, "FOV");
}

/// Two images of two points.
Reconstruction SmallReconstruction() {
  Reconstruction reconstruction;
  reconstruction.camera = test::PinholeCamera().parameters();
  const Camera camera(reconstruction.camera);
  reconstruction.points = {{4, {0, 0, 5}, {255, 0, 1}}, {9, {1, 1, 6}, {2, 3, 4}}};
  for (int i = 0; i < 2; ++i) {
    const SE3 pose(SO3(), Eigen::Vector3d(0.5 * i, 0, 0));
    ReconstructedImage image{10 * i, i == 0 ? "a.png" : "sub/b c.png", pose, {}};
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d pixel =
          *camera.Project(pose.Inverse() * reconstruction.points[k].in_world);
      image.observations.push_back({k, pixel, 0.5});
    }
    reconstruction.images.push_back(image);
  }
  return reconstruction;
}

TEST(ColmapModel, TextNamesImagesPointsAndTheirTracks) {
  Reconstruction reconstruction = SmallReconstruction();
  reconstruction.images[0].observations[0].pixel.x() += 3;
  const ColmapModel model = ToColmapText(reconstruction);
  EXPECT_THAT(model.cameras, HasSubstr("\n1 PINHOLE 640 480 "));
  EXPECT_THAT(model.images, HasSubstr("\n1 1 0 0 0 0 0 0 1 a.png\n"));
  EXPECT_THAT(model.images, HasSubstr("\n2 1 0 0 0 -0.5 0 0 1 sub/b c.png\n"));
  EXPECT_THAT(model.points, HasSubstr("\n5 0 0 5 255 0 1 1.5 1 0 2 0\n"));
  EXPECT_THAT(model.points, HasSubstr("\n10 1 1 6 2 3 4 0 1 1 2 1\n"));
}

TEST(ColmapModel, BinaryHoldsTheSameNumbers) {
  const Reconstruction reconstruction = SmallReconstruction();
  const ColmapModel model = ToColmapBinary(reconstruction);
  EXPECT_EQ(model.cameras.size(), 8 + 4 + 4 + 8 + 8 + 4 * 8u);
  const std::size_t image_size = 4 + 7 * 8 + 4 + 8 + 2 * 24;
  EXPECT_EQ(model.images.size(),
            8 + 2 * image_size + std::strlen("a.png") + 1 + std::strlen("sub/b c.png") + 1);
  EXPECT_EQ(model.points.size(), 8 + 2 * (8 + 24 + 3 + 8 + 8 + 2 * 8u));
  double x = 0;
  std::memcpy(&x, model.images.data() + 8 + 4 + 7 * 8 + 4 + 6 + 8, sizeof x);
  EXPECT_EQ(x, reconstruction.images[0].observations[0].pixel.x() + 0.5);
}

TEST(NerfstudioTransforms, CamerasLookAlongMinusZWithYUp) {
  Reconstruction reconstruction = SmallReconstruction();
  // The first camera is upright: its y axis (down) is the world's y axis.
  const auto json = ToTransforms(reconstruction, "images", "points.ply");
  EXPECT_EQ(json["frames"][1]["file_path"], "images/sub/b c.png");
  const auto matrix = json["frames"][1]["transform_matrix"];
  const auto column = [&](int c) {
    return Eigen::Vector3d(matrix[0][c], matrix[1][c], matrix[2][c]);
  };
  const SO3 turned = TransformsFromWorld(reconstruction);
  EXPECT_TRUE(column(1).isApprox(Eigen::Vector3d::UnitZ(), 1e-12)) << "up in the image is up";
  EXPECT_TRUE(column(2).isApprox(turned * Eigen::Vector3d(0, 0, -1), 1e-12)) << "backward";
  EXPECT_TRUE(column(3).isApprox(turned * Eigen::Vector3d(0.5, 0, 0), 1e-12));
  reconstruction.camera.model = CameraModel::kFov;
  EXPECT_THROW(ToTransforms(reconstruction, "images", "points.ply"), Error);
}

TEST(PointSelection, KeepsPointsOfKnownDepthAndTheirConsistentObservations) {
  Reconstruction reconstruction = SmallReconstruction();
  PointSelectionOptions options{2, 0.05, 3};
  // A baseline of 0.5 seen at 500 px and a noise of 0.5 px: sigma of the depth 5 is about 0.07.
  SelectPoints(options, reconstruction);
  EXPECT_EQ(reconstruction.points.size(), 2u);
  options.max_relative_depth_sigma = 0.001;
  Reconstruction none = reconstruction;
  SelectPoints(options, none);
  EXPECT_TRUE(none.points.empty());
  EXPECT_TRUE(none.images[0].observations.empty());
  options.max_relative_depth_sigma = 0.05;
  reconstruction.images[0].observations[0].pixel.x() += 2;  // Four standard deviations.
  SelectPoints(options, reconstruction);
  ASSERT_EQ(reconstruction.points.size(), 1u);
  EXPECT_EQ(reconstruction.points[0].id, 9);
  ASSERT_EQ(reconstruction.images[1].observations.size(), 1u);
  EXPECT_EQ(reconstruction.images[1].observations[0].point, 0);
}

TEST(PointFit, MinimizesTheSquaredPixelErrors) {
  Reconstruction reconstruction = SmallReconstruction();
  const Camera camera(reconstruction.camera);
  reconstruction.images[0].observations[0].pixel += Eigen::Vector2d(2, -1);
  const auto squared_error = [&](const Eigen::Vector3d& in_world) {
    double sum = 0;
    for (const ReconstructedImage& image : reconstruction.images) {
      const auto pixel = camera.Project(image.world_from_camera.Inverse() * in_world);
      sum += (*pixel - image.observations[0].pixel).squaredNorm();
    }
    return sum;
  };
  const Eigen::Vector3d exact = reconstruction.points[1].in_world;
  const double before = squared_error(reconstruction.points[0].in_world);
  reconstruction.points[1].in_world.z() += 0.2;
  FitPointsToPixels(reconstruction);
  const Eigen::Vector3d fitted = reconstruction.points[0].in_world;
  const double least = squared_error(fitted);
  // The row of the pixel is halfway between the two, and the disparity explains the column.
  EXPECT_NEAR(least, 0.5, 0.01);
  EXPECT_LT(least, before);
  for (const Eigen::Vector3d axis :
       {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}) {
    EXPECT_GT(squared_error(fitted + 1e-3 * axis), least);
    EXPECT_GT(squared_error(fitted - 1e-3 * axis), least);
  }
  EXPECT_TRUE(reconstruction.points[1].in_world.isApprox(exact, 1e-6));
}

TEST(PointColors, AreThoseOfTheFirstImageThatCanBeRead) {
  const test::TemporaryFolder folder;
  Reconstruction reconstruction = SmallReconstruction();
  reconstruction.images[0].name = "missing.png";
  reconstruction.images[1].name = "small.png";
  // Half the size of the camera's images, red on the left and blue on the right.
  cv::Mat image(240, 320, CV_8UC3, cv::Scalar(0, 0, 200));
  image.colRange(160, 320) = cv::Scalar(200, 0, 0);
  ASSERT_TRUE(cv::imwrite((folder.path() / "small.png").string(), image));
  ColorPoints(folder.path(), GrayLevels(), reconstruction);
  using Rgb = std::array<std::uint8_t, 3>;
  EXPECT_EQ(reconstruction.points[0].rgb, (Rgb{200, 0, 0}));  // At x = 269.5.
  EXPECT_EQ(reconstruction.points[1].rgb, (Rgb{0, 0, 200}));  // At x = 361.
}

TEST(Undistortion, MovesObservationsAndPixelsAlike) {
  const Camera camera(Distorted());
  const Undistortion undistortion(camera);
  const Camera& straight = undistortion.undistorted_camera();
  EXPECT_EQ(straight.parameters().k1, 0);
  const Eigen::Vector3d point(0.7, -0.5, 2);
  const Eigen::Vector2d distorted = *camera.Project(point);
  Reconstruction reconstruction;
  reconstruction.camera = camera.parameters();
  reconstruction.points = {{0, point, {}}};
  reconstruction.images = {{0, "a.png", SE3(), {{0, distorted, 1}}}};
  undistortion.Apply(reconstruction);
  const Eigen::Vector2d moved = reconstruction.images[0].observations[0].pixel;
  EXPECT_LT((moved - *straight.Project(point)).norm(), 1e-9);
  EXPECT_GT((moved - distorted).norm(), 5);
  // A bright disc around the distorted pixel is found around the other one.
  cv::Mat image = cv::Mat::zeros(camera.height(), camera.width(), CV_8U);
  image(cv::Rect(static_cast<int>(distorted.x()) - 4, static_cast<int>(distorted.y()) - 4, 9, 9)) =
      255;
  const cv::Mat undistorted = undistortion.Apply(image);
  EXPECT_EQ(undistorted.at<std::uint8_t>(static_cast<int>(std::lround(moved.y())),
                                         static_cast<int>(std::lround(moved.x()))),
            255);
}

}  // namespace
}  // namespace corvo
