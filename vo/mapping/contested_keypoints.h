// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/map/frame.h"

namespace corvo {

/// Removes keypoints that are likely on a moving object from a posed frame: those without a
/// landmark whose nearest matched keypoints are, for the most part, among `contradictions`, the
/// keypoints whose landmarks contradict the frame's pose. Returns the share of all keypoints that
/// was removed, 0 to 1.
double RemoveContestedKeypoints(const std::vector<int>& contradictions, Frame& frame);

}  // namespace corvo
