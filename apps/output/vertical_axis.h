// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/trajectory.h"

namespace corvo {

/// The coordinate axes of a world as a map and a height profile show them. A map seen from above,
/// with `across` to the right and `along` upwards, is not mirrored: a turn to the right stays one.
struct VerticalAxis {
  int up = 1;        ///< 0, 1 or 2 for x, y or z.
  double sign = -1;  ///< Height = sign * coordinate `up`.
  int across = 0;
  int along = 2;
};

/// Returns the axes of a world whose axis `up`, in its positive direction or, for a sign of -1, its
/// negative one, points upwards.
VerticalAxis AxesWithUp(int up, double sign);

/// Returns the axes of the world of these poses. Its vertical is the coordinate axis nearest to the
/// mean of the cameras' y axes, which point down in cameras that are held upright. Without poses,
/// it is that of the first camera of a run: y points down.
VerticalAxis FindVerticalAxis(const PoseSequence& poses);

/// Returns whether the poses have rotations of their own: false if all are the same, as in ground
/// truth that has positions only.
bool HasRotations(const PoseSequence& poses);

}  // namespace corvo
