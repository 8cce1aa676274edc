// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>

#include <opencv2/core.hpp>

#include "vo/core/frame_result.h"
#include "vo/map/frame.h"

namespace corvo {

/// Returns the image in color with the frame's keypoints and a caption with its index, state,
/// reason and number of inliers. The caption is white, or yellow if there is a reason. Where `mask`
/// is not empty and zero, the image is dark red. Keypoints that observe a landmark are green
/// circles, with a line from the landmark's pixel in `previous`; the others are gray dots.
cv::Mat DrawTracks(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                   const FrameResult& result, const std::map<LandmarkId, cv::Point2f>& previous);

/// Draws the tracked features of every frame into a folder: 000000.jpg, 000001.jpg ...
class TrackDrawings {
 public:
  /// Creates the folder. With an empty path, nothing is drawn. Throws corvo::Error if the folder
  /// cannot be created.
  explicit TrackDrawings(const std::filesystem::path& folder);

  /// Draws a frame, which was searched for features where `mask` is empty or not zero. Throws
  /// corvo::Error if the image cannot be written.
  void Add(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
           const FrameResult& result);

 private:
  std::filesystem::path folder_;
  std::map<LandmarkId, cv::Point2f> previous_;
};

}  // namespace corvo
