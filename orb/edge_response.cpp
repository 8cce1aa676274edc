// SPDX-License-Identifier: MIT
#include "orb/edge_response.h"

#include <cmath>

namespace corvo::orb {

double EigenvalueShare(const Patch& patch) {
  constexpr int kRadius = 4;
  int xx = 0, xy = 0, yy = 0;
  for (int y = -kRadius; y <= kRadius; ++y) {
    const std::uint8_t* p = patch.pixels.data() + (Patch::kRadius + y) * Patch::kSide;
    for (int x = Patch::kRadius - kRadius; x <= Patch::kRadius + kRadius; ++x) {
      const int by_x = p[x + 1] - p[x - 1], by_y = p[x + Patch::kSide] - p[x - Patch::kSide];
      xx += by_x * by_x;
      xy += by_x * by_y;
      yy += by_y * by_y;
    }
  }
  const double sum = xx + yy, difference = std::hypot(xx - yy, 2.0 * xy);
  return sum > 0 ? (sum - difference) / (sum + difference) : 0;
}

}  // namespace corvo::orb
