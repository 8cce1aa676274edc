// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "apps/codecs/codecs.h"
#include "apps/output/drawing_sink.h"
#include "apps/output/output_folder.h"

namespace corvo {

/// Returns whether drawings go to a film of this name rather than to a folder: it has the extension
/// .mp4, .mov, .mkv or .avi, in upper or lower case. Throws corvo::Error for extensions of other
/// videos.
bool IsFilmName(const std::filesystem::path& file);

/// Returns the frame rate of a film, in Hz: that of the median of the steps between timestamps, at
/// least 1 and at most 240; 30 for fewer than two timestamps.
double FilmFrameRate(const std::vector<TimeNs>& times);

/// Drawings as a film with one image for each frame: Motion JPEG (.avi) or MPEG-4 Part 2. It is
/// put in place by Finish(), all or nothing, and has a manifest of its own.
class Film : public DrawingSink {
 public:
  /// Throws corvo::Error if the file cannot be written or is not corvo's.
  Film(const std::filesystem::path& file, bool replaces_foreign);

  /// The drawings must have one size; the first ones are held until the frame rate is known.
  void Add(const cv::Mat& drawing, const FrameResult& frame) override;
  /// A film of an incomplete run does not replace one of a complete run; it is then discarded with
  /// a warning.
  void Finish(bool is_complete) override;

 private:
  /// Opens the film with the frame rate of the drawings that wait, and writes them.
  void Start();
  void Write(const cv::Mat& drawing);

  std::filesystem::path file_;
  OutputFolder output_;
  std::filesystem::path staged_;
  std::unique_ptr<VideoOutput> writer_;
  std::vector<std::pair<TimeNs, cv::Mat>> waiting_;
  int num_written_ = 0;
};

}  // namespace corvo
