// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "apps/output/drawing_sink.h"
#include "apps/output/path_inset.h"
#include "apps/output/track_history.h"
#include "vo/core/frame_result.h"
#include "vo/map/frame.h"

namespace corvo {

/// Draws every frame of a run with its tracked features, its state and the path so far, into a
/// folder or, if the path has the extension of a film, into a film.
class TrackDrawings {
 public:
  /// Prepares the folder or the film. With an empty path, nothing is drawn. Throws corvo::Error if
  /// it cannot be written or holds what corvo has not written, unless `replaces_foreign` is set.
  explicit TrackDrawings(const std::filesystem::path& path, bool replaces_foreign = false);

  /// Draws a frame, which was searched for features where `mask` is empty or not zero. Throws
  /// corvo::Error if the drawing cannot be written.
  void Add(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
           const FrameResult& result);
  /// Draws a frame without an image: black, in that size.
  void AddMissing(const cv::Size& size, const FrameResult& result);

  /// Puts a film in place. Throws corvo::Error if it cannot be written in full.
  void Finish(bool is_complete);

 private:
  void AddDrawing(cv::Mat drawing, const FrameResult& result);

  std::unique_ptr<DrawingSink> sink_;
  TrackHistory tracks_;
  PathInset path_;
};

}  // namespace corvo
