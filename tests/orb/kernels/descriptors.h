// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <vector>

#include "orb/types.h"
#include "tests/orb/kernels/every_instruction_set.h"

namespace corvo::test {

/// Returns descriptors of independent bits.
inline std::vector<orb::Descriptor> RandomDescriptors(int count, unsigned seed) {
  const auto bytes = RandomBytes(32 * static_cast<std::size_t>(count), seed);
  std::vector<orb::Descriptor> descriptors(count);
  if (count > 0) std::memcpy(descriptors.data(), bytes.data(), bytes.size());
  return descriptors;
}

/// Returns descriptors in which only three bits vary, so that distances are often equal.
inline std::vector<orb::Descriptor> SimilarDescriptors(int count, unsigned seed) {
  const auto bytes = RandomBytes(count, seed);
  std::vector<orb::Descriptor> descriptors(count);
  for (int i = 0; i < count; ++i) descriptors[i].bytes[31] = bytes[i] & 0x91;
  return descriptors;
}

/// Returns a descriptor whose bytes all are `byte`.
inline orb::Descriptor FilledDescriptor(std::uint8_t byte) {
  orb::Descriptor descriptor;
  descriptor.bytes.fill(byte);
  return descriptor;
}

}  // namespace corvo::test
