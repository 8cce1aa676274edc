// SPDX-License-Identifier: MIT
#pragma once

#include "vo/map/frame.h"

namespace corvo::test {

/// Returns a frame without features.
inline Frame PosedFrame(TimeNs time_ns, const SE3& world_from_camera) {
  Frame frame;
  frame.time_ns = time_ns;
  frame.world_from_camera = world_from_camera;
  return frame;
}

}  // namespace corvo::test
