// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>

#include <opencv2/core.hpp>

#include "apps/output/manifest.h"
#include "vo/core/frame_result.h"
#include "vo/map/frame.h"

namespace corvo {

/// Returns the image in color with the frame's keypoints and a caption with its index, state,
/// reason and number of inliers. The caption is white, or yellow if there is a reason. Where `mask`
/// is not empty and zero, the image is dark red. Keypoints that observe a landmark are green
/// circles, with a line from the landmark's pixel in `previous`; the others are gray dots.
cv::Mat DrawTracks(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                   const FrameResult& result, const std::map<LandmarkId, cv::Point2f>& previous);

/// Draws the tracked features of every frame into a folder: 000000.jpg, 000001.jpg ... Drawings
/// that the folder's manifest lists are removed with the first new one.
class TrackDrawings {
 public:
  /// Creates the folder. With an empty path, nothing is drawn. Throws corvo::Error if the folder
  /// cannot be created or holds files with names of drawings that corvo has not written, unless
  /// `replaces_foreign` is set.
  explicit TrackDrawings(const std::filesystem::path& folder, bool replaces_foreign = false);
  /// Writes the manifest of the drawings. Without any, removes the folder if it was created.
  ~TrackDrawings();
  TrackDrawings(const TrackDrawings&) = delete;
  TrackDrawings& operator=(const TrackDrawings&) = delete;

  /// Draws a frame, which was searched for features where `mask` is empty or not zero. Throws
  /// corvo::Error if the image cannot be written.
  void Add(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
           const FrameResult& result);

 private:
  void RemoveEarlier();

  std::filesystem::path folder_;
  bool made_folder_ = false;
  Manifest earlier_;
  Manifest written_;
  std::map<LandmarkId, cv::Point2f> previous_;
};

}  // namespace corvo
