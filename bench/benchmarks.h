// SPDX-License-Identifier: MIT
#pragma once

#include "bench/images.h"

namespace corvo::bench {

// These functions register comparisons with Google Benchmark. `images` must outlive the run; items
// are visited `repeats` times.

/// Registers corvo's default features against cv::ORB and cv::SIFT with the same number of
/// keypoints, on the best instruction set and on AVX2, and two threads against one.
void RegisterExtraction(ImageSets& images, int repeats);

/// Registers FAST corners against cv::FAST, on the best instruction set and on AVX2. The run throws
/// corvo::Error unless both find the same corners.
void RegisterFast(ImageSets& images, int repeats);

/// Registers the search for the two nearest of 2000 descriptors for 2000 queries against
/// cv::BFMatcher, on every instruction set. The run throws corvo::Error unless both find the same
/// distances.
void RegisterMatching(ImageSets& images, int repeats);

/// Registers the stages of corvo's extraction on the best instruction set. The counters are named
/// as in kStages and are the median over the images of the least time, ms. The run throws
/// corvo::Error unless the keypoints of the first image equal those of orb::Extractor.
void RegisterStages(ImageSets& images, int repeats);

}  // namespace corvo::bench
