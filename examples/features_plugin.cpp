// SPDX-License-Identifier: MIT
// A shared library with a C function, for programs in other languages: features as an array.
#include <algorithm>
#include <cstddef>
#include <exception>
#include <iterator>

#include <corvo/orb/extractor.h>
#include <opencv2/core.hpp>

/// Writes x, y, angle (degrees) and octave of at most `capacity` keypoints of an 8-bit gray image
/// to `keypoints`, four numbers each, and returns their number, or -1 if the image is invalid.
extern "C" int extract_features(const unsigned char* pixels, int width, int height,
                                std::size_t stride, float* keypoints, int capacity) {
  try {
    const cv::Mat image(height, width, CV_8UC1, const_cast<unsigned char*>(pixels), stride);
    const corvo::orb::Features features = corvo::orb::Extractor().Extract(image);
    const int count = std::min(capacity, static_cast<int>(features.keypoints.size()));
    for (int i = 0; i < count; ++i) {
      const corvo::orb::Keypoint& keypoint = features.keypoints[i];
      const float values[] = {keypoint.x, keypoint.y, keypoint.angle_deg,
                              static_cast<float>(keypoint.octave)};
      std::copy(std::begin(values), std::end(values), keypoints + 4 * i);
    }
    return count;
  } catch (const std::exception&) {  // No exception leaves a C function.
    return -1;
  }
}
