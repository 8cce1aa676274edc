// SPDX-License-Identifier: MIT
#pragma once

#include "bench/images.h"

namespace corvo::bench {

// Each registers its comparisons with Google Benchmark. `images` outlives the run; items are
// visited `repeats` times.

/// corvo's default features against cv::ORB and cv::SIFT with the same number of keypoints, on the
/// best instruction set and on AVX2; two threads against one.
void RegisterExtraction(ImageSets& images, int repeats);

/// FAST corners against cv::FAST, on the best instruction set and on AVX2. The run throws
/// corvo::Error unless both find the same corners.
void RegisterFast(ImageSets& images, int repeats);

/// The two nearest of 2000 descriptors for 2000 others against cv::BFMatcher, on every instruction
/// set. The run throws corvo::Error unless both find the same distances.
void RegisterMatching(ImageSets& images, int repeats);

/// The stages of corvo's extraction, on the best instruction set: counters named as in kStages, the
/// median over images of the least time, ms. The run throws corvo::Error unless they find the
/// keypoints that orb::Extractor finds.
void RegisterStages(ImageSets& images, int repeats);

}  // namespace corvo::bench
