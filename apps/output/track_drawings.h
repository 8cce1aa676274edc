// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>

#include <opencv2/core.hpp>

#include "vo/core/frame_result.h"
#include "vo/map/frame.h"

namespace corvo {

/// The image in color, with the frame's keypoints: those that see a landmark as green circles,
/// with a line from where `previous` has that landmark, the others as gray dots; and on top the
/// frame's number, state and inliers.
cv::Mat DrawTracks(const cv::Mat& image, const Frame& frame, const FrameResult& result,
                   const std::map<LandmarkId, cv::Point2f>& previous);

/// Draws the tracked features of every frame into a folder: 000000.jpg, 000001.jpg ...
class TrackDrawings {
 public:
  /// Makes the folder; none is drawn into an empty path. Throws corvo::Error where it cannot.
  explicit TrackDrawings(const std::filesystem::path& folder);

  /// Throws corvo::Error where the image cannot be written.
  void Add(const cv::Mat& image, const Frame& frame, const FrameResult& result);

 private:
  std::filesystem::path folder_;
  std::map<LandmarkId, cv::Point2f> previous_;
};

}  // namespace corvo
