// SPDX-License-Identifier: MIT
#include "orb/harris.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace corvo::orb {

std::int64_t HarrisResponse(const cv::Mat& image, int x, int y) {
  constexpr int kRadius = 3;
  const auto stride = static_cast<std::ptrdiff_t>(image.step);
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  for (int row = y - kRadius; row <= y + kRadius; ++row) {
    const std::uint8_t* here = image.ptr<std::uint8_t>(row) + x;
    const std::uint8_t* above = here - stride;
    const std::uint8_t* below = here + stride;
    for (int i = -kRadius; i <= kRadius; ++i) {
      const std::int64_t gx = (above[i + 1] - above[i - 1]) + 2 * (here[i + 1] - here[i - 1]) +
                              (below[i + 1] - below[i - 1]);
      const std::int64_t gy =
          (below[i - 1] - above[i - 1]) + 2 * (below[i] - above[i]) + (below[i + 1] - above[i + 1]);
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  }
  return 25 * (xx * yy - xy * xy) - (xx + yy) * (xx + yy);
}

void RankByHarris(const cv::Mat& image, int threshold, std::vector<Corner>& corners) {
  using Rank = std::pair<bool, std::int64_t>;
  std::vector<Rank> ranks;
  ranks.reserve(corners.size());
  for (const Corner& corner : corners) {
    ranks.emplace_back(corner.score >= threshold, HarrisResponse(image, corner.x, corner.y));
  }
  std::vector<Rank> order = ranks;
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto place = std::lower_bound(order.begin(), order.end(), ranks[i]);
    corners[i].score = static_cast<int>(place - order.begin());
  }
}

}  // namespace corvo::orb
