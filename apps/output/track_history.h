// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <vector>

#include <opencv2/core/types.hpp>

#include "vo/map/frame.h"

namespace corvo {

/// A landmark's observations in consecutive frames.
struct Track {
  int age = 0;                      ///< Number of frames in which the landmark was observed.
  int last_frame = 0;               ///< Index of the last of them.
  std::vector<cv::Point2f> pixels;  ///< Its last pixels, at most kMaxPixels, the newest last.

  static constexpr std::size_t kMaxPixels = 10;
};

/// The tracks of the landmarks that a frame observes, for drawings.
class TrackHistory {
 public:
  /// Adds the observations of the next frame. A track ends if its landmark is not observed for more
  /// than Track::kMaxPixels frames.
  void Add(const Frame& frame);

  /// Returns the track of a landmark that the last frame observes.
  const Track& Of(LandmarkId landmark) const { return tracks_.at(landmark); }

 private:
  std::map<LandmarkId, Track> tracks_;
};

/// Returns the pixel at which a keypoint was detected.
cv::Point2f PixelOf(const Frame& frame, int keypoint);

}  // namespace corvo
