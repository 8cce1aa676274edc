// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/conventions.h"
#include "vo/lie/sim3.h"

namespace corvo {

/// The similarity that makes two segments one: the later one becomes part of the earlier one.
struct SegmentJoin {
  int earlier = kNoId;
  int later = kNoId;
  Sim3 earlier_from_later;
};

}  // namespace corvo
