// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/map/frame.h"
#include "vo/map/guided_matching.h"
#include "vo/map/map.h"

namespace corvo {

/// Returns whether more of `landmarks` are matched where the pose of a frame projects them than
/// chance explains. The rate of chance matches is measured: the same landmarks are searched for at
/// displaced positions in the same image, so that the number and spread of keypoints, the size of
/// the image and the gates on descriptors are all accounted for. The bound on the tail of the
/// binomial distribution is that of Hoeffding, 1963; the principle is the a-contrario test of
/// Desolneux, Moisan and Morel, "Meaningful alignments", 2000.
bool IsBeyondChance(const Map& map, const std::vector<LandmarkId>& landmarks, const Frame& frame,
                    const GuidedMatchingOptions& matching);

}  // namespace corvo
