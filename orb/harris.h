// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/fast.h"

namespace corvo::orb {

/// Returns Harris and Stephens' corner response with k = 1/25, in integers:
///
///     25 det(M) - trace(M)^2,   M = sum over 7x7 pixels of g g^T,
///
/// where g is the 3x3 Sobel gradient ("A combined corner and edge detector", 1988). `image` is
/// 8-bit, one channel; (x, y) is at least 4 px from its edges.
std::int64_t HarrisResponse(const cv::Mat& image, int x, int y);

/// Replaces the scores of a level's corners by their ranks, the best corner having the highest:
/// corners with a score below `threshold` rank below all others; within each group the order is
/// that of HarrisResponse(). Equal corners have equal ranks.
void RankByHarris(const cv::Mat& image, int threshold, std::vector<Corner>& corners);

}  // namespace corvo::orb
