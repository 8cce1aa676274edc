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

/// Casts rays through the camera's own model, so that any distortion it has is in the image.
///
/// One ray through each corner of the pixels says where surfaces end. A pixel whose corners see the
/// same surface is shaded once, at its center; any other from 16 rays. Deterministic for
/// any number of threads.
class Renderer {
 public:
  explicit Renderer(const Camera& camera);

  /// CV_8UC1. Black where the camera has no ray. `more` is in the scene besides, with textures of
  /// the scene.
  cv::Mat Render(const Scene& scene, const SE3& scene_from_camera,
                 const std::vector<Quad>& more = {}) const;

  /// CV_32FC1: z in the camera of what the ray through each pixel's center meets, m; 0 for nothing.
  cv::Mat RenderDepth(const Scene& scene, const SE3& scene_from_camera,
                      const std::vector<Quad>& more = {}) const;

  const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
  /// (x/z, y/z) of the rays through the corners (x - 0.5, y - 0.5) of the pixels, (width + 1) a
  /// row; NaN for none.
  std::vector<Eigen::Vector2d> corner_rays_;
};

}  // namespace corvo::synthetic
