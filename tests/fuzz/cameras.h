// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "tests/fuzz/input.h"
#include "vo/camera/camera_parameters.h"

namespace corvo::fuzz {

/// Returns a camera of any model. Its numbers are those of common cameras if `is_common`, and
/// otherwise any within their ranges or a little beyond them.
inline CameraParameters TakeCamera(int width, int height, bool is_common, Input& input) {
  CameraParameters camera;
  camera.model = static_cast<CameraModel>(input.Int(0, 2));
  CameraParameters::Visit(camera, [&](const char*, auto& value, auto min, auto max, const char*) {
    if constexpr (std::is_floating_point_v<std::remove_reference_t<decltype(value)>>) {
      if (is_common) {
        value = input.Real(-0.3, 0.3);
      } else {
        value = input.Bool() ? input.Real(min, max) : input.Number(2 * max);
      }
    }
  });
  camera.width = width;
  camera.height = height;
  if (!is_common) return camera;
  camera.fx = camera.fy = width * (0.8 + camera.fx);
  camera.cx = 0.5 * width;
  camera.cy = 0.5 * height;
  camera.omega = std::abs(camera.omega);
  return camera;
}

}  // namespace corvo::fuzz
