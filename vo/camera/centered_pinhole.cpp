// SPDX-License-Identifier: MIT
#include "vo/camera/centered_pinhole.h"

#include <cmath>
#include <numbers>

namespace corvo {

CameraParameters CenteredPinhole(double focal_px, int width, int height) {
  CameraParameters camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal_px;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

double FocalOfFov(double fov_deg, double width) {
  return 0.5 * width / std::tan(fov_deg * std::numbers::pi / 360);
}

double FovOfFocal(double focal, double width) {
  return 2 * std::atan(0.5 * width / focal) * 180 / std::numbers::pi;
}

}  // namespace corvo
