// SPDX-License-Identifier: MIT
#include "apps/export/undistortion.h"

#include <opencv2/imgproc.hpp>

namespace corvo {
namespace {

Camera WithoutDistortion(const CameraParameters& given) {
  CameraParameters camera;
  camera.width = given.width;
  camera.height = given.height;
  camera.fx = given.fx;
  camera.fy = given.fy;
  camera.cx = given.cx;
  camera.cy = given.cy;
  return Camera(camera);
}

}  // namespace

Undistortion::Undistortion(const Camera& camera)
    : distorted_(camera),
      undistorted_(WithoutDistortion(camera.parameters())),
      map_(camera.height(), camera.width(), CV_32FC2) {
  for (int y = 0; y < camera.height(); ++y) {
    auto* row = map_.ptr<cv::Vec2f>(y);
    for (int x = 0; x < camera.width(); ++x) {
      const Eigen::Vector2d ray = *undistorted_.Undistort(Eigen::Vector2d(x, y));
      const auto pixel = distorted_.Project(ray.homogeneous());
      row[x] = pixel ? cv::Vec2f(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()))
                     : cv::Vec2f(-1e4F, -1e4F);
    }
  }
}

cv::Mat Undistortion::Apply(const cv::Mat& image) const {
  cv::Mat undistorted;
  cv::remap(image, undistorted, map_, cv::noArray(), cv::INTER_LINEAR);
  return undistorted;
}

void Undistortion::Apply(Reconstruction& reconstruction) const {
  reconstruction.camera = undistorted_.parameters();
  for (ReconstructedImage& image : reconstruction.images) {
    std::erase_if(image.observations, [&](PointObservation& observation) {
      const auto ray = distorted_.Undistort(observation.pixel);
      if (ray) observation.pixel = *undistorted_.Project(ray->homogeneous());
      return !ray;
    });
  }
}

}  // namespace corvo
