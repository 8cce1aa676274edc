// SPDX-License-Identifier: MIT
#include "orb/descriptor.h"

namespace corvo::orb {

Describer::Describer(const Pattern& pattern, int bins, bool upright)
    : patterns_(pattern, bins), upright_(upright), tests_(bins) {
  for (int bin = 0; bin < bins; ++bin) {
    for (int i = 0; i < kNumTests; ++i) {
      const BinaryTest& test = patterns_[bin][i];
      tests_[bin].p[i] = kernels::PatchIndex(test.p.x, test.p.y);
      tests_[bin].q[i] = kernels::PatchIndex(test.q.x, test.q.y);
    }
  }
}

Descriptor Describer::Describe(const std::uint16_t* sums, std::ptrdiff_t stride,
                               float angle_deg) const {
  const int bin = upright_ ? 0 : patterns_.NearestBin(angle_deg);
  Descriptor descriptor;
  kernels::TestPatch(sums, stride, tests_[bin], descriptor.bytes.data());
  return descriptor;
}

}  // namespace corvo::orb
