// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orb/types.h"

namespace corvo::bench {

/// Descriptors of images. From index `num_real` on, they are copies with some bits flipped.
struct Collection {
  std::vector<orb::Descriptor> descriptors;
  int num_images = 0;
  int num_real = 0;
};

/// Returns `size` descriptors: 1500 of each image of KITTI 03, 05 and 06 and 7-Scenes; if these are
/// too few, also copies of them with 1 to 8 bits flipped. Throws corvo::Error if images are
/// missing.
Collection MakeCollection(int size);

/// Returns `count` descriptors drawn from the collection, each with 25 to 50 bits flipped.
/// Deterministic for a seed.
std::vector<orb::Descriptor> MakeQueries(const std::vector<orb::Descriptor>& collection, int count,
                                         std::uint64_t seed);

/// Returns the descriptor with `count` different random bits flipped.
orb::Descriptor FlipBits(orb::Descriptor descriptor, int count, std::uint64_t& state);

}  // namespace corvo::bench
