// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/export/reconstruction.h"

namespace corvo {

/// The three files of a COLMAP model, https://colmap.github.io/format.html, as text or as binary
/// data. Camera and image ids start at 1, in the order of the images; a point's id is that of its
/// landmark plus 1. The error of a point is the mean of its reprojection errors, px; 0 without
/// observations.
struct ColmapModel {
  std::string cameras;
  std::string images;
  std::string points;
};

/// Returns the contents of cameras.txt, images.txt and points3D.txt. Numbers read back unchanged.
ColmapModel ToColmapText(const Reconstruction& reconstruction);

/// Returns the contents of cameras.bin, images.bin and points3D.bin (little-endian).
ColmapModel ToColmapBinary(const Reconstruction& reconstruction);

}  // namespace corvo
