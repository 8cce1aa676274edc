// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/lie/sim3.h"

namespace corvo {

/// The similarity that makes two segments one: the later one becomes part of the earlier one.
struct SegmentJoin {
  int earlier = kNoId;
  int later = kNoId;
  Sim3 earlier_from_later;
};

/// A point in the gauge of its segment.
struct PointInSegment {
  int segment = kNoId;
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();
};

/// Returns a point after the joins from `joins[first]` on: what is known of a segment before it
/// becomes part of an earlier one is expressed in the gauge that it had until then.
inline PointInSegment ApplyJoins(const std::vector<SegmentJoin>& joins, int first,
                                 PointInSegment point) {
  for (std::size_t i = first; i < joins.size(); ++i) {
    if (joins[i].later != point.segment) continue;
    point = {joins[i].earlier, joins[i].earlier_from_later * point.in_world};
  }
  return point;
}

}  // namespace corvo
