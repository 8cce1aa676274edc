// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/support/random.h"
#include "tests/system/recording.h"

namespace corvo::test {

/// Returns the recording with every image repeated, 2 or more times in all. A repeated image
/// differs from its original by at most one gray level, as a codec leaves it.
Recording Repeat(const Recording& recording, int times, Random& random);

/// Returns the recording with texture over the bottom `share` of each image that stays in place.
Recording AddOverlay(Recording recording, double share, Random& random);

/// The way in which a vehicle moves through the image.
enum class VehicleMotion {
  kCrossing,  ///< From the left border to the right one.
  kBeside,    ///< Enters from the left, stays in the left part of the image, and leaves.
  kAhead,     ///< Cuts in from the right, stays in the middle of the image, and leaves.
};

/// A textured vehicle in some images of a recording.
struct Vehicle {
  VehicleMotion motion = VehicleMotion::kCrossing;
  int first_frame = 12;
  int num_frames = 40;
  double share = 0.4;  ///< Share of the image that it covers.
};

Recording AddVehicle(Recording recording, const Vehicle& vehicle, Random& random);

/// Returns the first half of `first` followed by the second half of `second`, another place. Both
/// have images of one size.
Recording CutTo(const Recording& first, const Recording& second);

/// Returns the recording with Gaussian blur of `sigma_px` in `num_frames` images from `first_frame`
/// on.
Recording Blur(Recording recording, double sigma_px, int first_frame, int num_frames);

/// Returns the recording with its images and camera scaled.
Recording Scale(Recording recording, double factor);

/// Returns the recording with Gaussian noise of `sigma` gray levels on every pixel.
Recording AddNoise(Recording recording, double sigma, Random& random);

}  // namespace corvo::test
