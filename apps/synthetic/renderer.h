// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "apps/synthetic/scene.h"
#include "vo/camera/camera.h"
#include "vo/lie/se3.h"

namespace corvo::synthetic {

/// Renders by casting rays through the camera's model, so that images have its distortion.
///
/// One ray is cast through each pixel corner. A pixel whose corners meet the same surface is shaded
/// once, at its center; any other pixel is shaded from 16 rays. The result does not depend on the
/// number of threads.
class Renderer {
 public:
  explicit Renderer(const Camera& camera);

  /// Returns the image, CV_8UC1, black where the camera has no ray. `more` are additional quads,
  /// which use the textures of the scene.
  cv::Mat Render(const Scene& scene, const SE3& scene_from_camera,
                 const std::vector<Quad>& more = {}) const;

  /// Returns the depth image, CV_32FC1: the z coordinate in the camera frame of the surface at each
  /// pixel's center, m; 0 if there is none.
  cv::Mat RenderDepth(const Scene& scene, const SE3& scene_from_camera,
                      const std::vector<Quad>& more = {}) const;

  const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
  /// The rays (x/z, y/z) through the pixel corners (x - 0.5, y - 0.5), row by row with width + 1
  /// entries each; NaN if there is no ray.
  std::vector<Eigen::Vector2d> corner_rays_;
};

}  // namespace corvo::synthetic
