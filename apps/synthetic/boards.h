// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "apps/synthetic/scene.h"
#include "vo/camera/camera.h"
#include "vo/lie/se3.h"

namespace corvo::synthetic {

/// Independently moving objects: three boards close to the camera, one above the other, which slide
/// back and forth across its view and together cover a given fraction of the image.
class Boards {
 public:
  /// `share` is the covered fraction of the image, 0 to 0.8. It is exact for a camera without
  /// distortion, unless something is nearer than the boards. Adds the boards' textures to `scene`.
  Boards(const Camera& camera, double share, Scene* scene);

  /// Returns the boards, in the scene's frame, at the given time.
  std::vector<Quad> At(const SE3& scene_from_camera, double seconds) const;

 private:
  Eigen::Vector2d corner_;  ///< (x/z, y/z) of the image's upper left corner.
  Eigen::Vector2d image_;   ///< Width and height of the image in (x/z, y/z).
  double width_;            ///< Width of a board as a fraction of the image width.
  std::vector<int> textures_;
};

}  // namespace corvo::synthetic
