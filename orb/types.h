// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace corvo::orb {

/// An oriented FAST corner. Integer coordinates are pixel centers.
struct Keypoint {
  float x = 0;          ///< Column in the input image (level 0), px.
  float y = 0;          ///< Row in the input image (level 0), px.
  float angle_deg = 0;  ///< Direction of the intensity centroid, [0, 360), from x towards y.
  float response = 0;   ///< FAST score or Harris response, as ranked; comparable within one image.
  int octave = 0;       ///< Pyramid level of the detection; 0 is the finest.

  bool operator==(const Keypoint&) const = default;
};

/// The outcomes of 256 binary tests. Test i is bit i % 8 of byte i / 8.
struct alignas(8) Descriptor {
  std::array<std::uint8_t, 32> bytes{};

  bool operator==(const Descriptor&) const = default;
};

/// Keypoints and their descriptors, with equal indices.
struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;

  bool operator==(const Features&) const = default;
};

}  // namespace corvo::orb
