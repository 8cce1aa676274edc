#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace corvo::orb {

/// Harris and Stephens' corner response with k = 1/25, in integers:
///
///     25 det(M) - trace(M)^2,   M = sum over 7x7 pixels of g g^T,
///
/// where g is the 3x3 Sobel gradient ("A combined corner and edge detector", 1988). `image` is
/// 8-bit, one channel; (x, y) is at least 4 px from its edges.
std::int64_t HarrisResponse(const cv::Mat& image, int x, int y);

}  // namespace corvo::orb
