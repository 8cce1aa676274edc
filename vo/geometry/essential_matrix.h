// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/lie/se3.h"

namespace corvo {

/// Returns the essential matrix E = [t]× R of a motion: y' E x = 0 for the rays (x/z, y/z, 1) of
/// one point, x in the first camera and y in the second (Hartley and Zisserman, Multiple View
/// Geometry, 9.6).
inline Eigen::Matrix3d EssentialMatrix(const SE3& second_from_first) {
  return SO3::Hat(second_from_first.translation()) * second_from_first.rotation().matrix();
}

}  // namespace corvo
