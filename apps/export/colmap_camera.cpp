// SPDX-License-Identifier: MIT
#include "apps/export/colmap_camera.h"

namespace corvo {
namespace {

ColmapCamera FromRadialTangential(const CameraParameters& c) {
  std::vector<double> parameters = {c.fx, c.fy, c.cx + 0.5, c.cy + 0.5};
  const bool is_distorted = c.k1 != 0 || c.k2 != 0 || c.p1 != 0 || c.p2 != 0 || c.k3 != 0;
  if (!is_distorted) return {1, "PINHOLE", parameters};
  parameters.insert(parameters.end(), {c.k1, c.k2, c.p1, c.p2});
  if (c.k3 == 0) return {4, "OPENCV", parameters};
  parameters.insert(parameters.end(), {c.k3, 0, 0, 0});
  return {6, "FULL_OPENCV", parameters};
}

}  // namespace

ColmapCamera ToColmap(const CameraParameters& c) {
  switch (c.model) {
    case CameraModel::kPinhole:
      return FromRadialTangential(c);
    case CameraModel::kKb4:
      return {5, "OPENCV_FISHEYE", {c.fx, c.fy, c.cx + 0.5, c.cy + 0.5, c.k1, c.k2, c.k3, c.k4}};
    case CameraModel::kFov:
      return {7, "FOV", {c.fx, c.fy, c.cx + 0.5, c.cy + 0.5, c.omega}};
  }
  return {};
}

}  // namespace corvo
