// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "apps/synthetic/scene.h"
#include "vo/camera/camera.h"
#include "vo/lie/se3.h"

namespace corvo::synthetic {

/// Things that move by themselves: three boards close before the camera, which slide back and forth
/// across it one above the other, and together hide a given share of the image.
class Boards {
 public:
  /// `share` of the image, 0 to 0.8; exact for a camera without distortion, unless something is
  /// nearer than the boards. Draws them into `scene`, whose textures they use from then on.
  Boards(const Camera& camera, double share, Scene* scene);

  /// The boards in the scene of that time.
  std::vector<Quad> At(const SE3& scene_from_camera, double seconds) const;

 private:
  Eigen::Vector2d corner_;  ///< (x/z, y/z) of the image's upper left corner.
  Eigen::Vector2d image_;   ///< Width and height of the image in the same.
  double width_;            ///< Of a board, as a share of the image's.
  std::vector<int> textures_;
};

}  // namespace corvo::synthetic
