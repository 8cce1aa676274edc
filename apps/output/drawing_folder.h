// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "apps/output/drawing_sink.h"
#include "apps/output/manifest.h"

namespace corvo {

/// Drawings as images in a folder: 000000.jpg, 000001.jpg ... Drawings that the folder's manifest
/// lists are removed with the first new one.
class DrawingFolder : public DrawingSink {
 public:
  /// Creates the folder. Throws corvo::Error if it cannot be created or holds files with names of
  /// drawings that corvo has not written, unless `replaces_foreign` is set.
  DrawingFolder(const std::filesystem::path& folder, bool replaces_foreign);
  /// Writes the manifest of the drawings. Without any, removes the folder if it was created.
  ~DrawingFolder() override;
  DrawingFolder(const DrawingFolder&) = delete;
  DrawingFolder& operator=(const DrawingFolder&) = delete;

  void Add(const cv::Mat& drawing, const FrameResult& frame) override;
  void Finish(bool) override {}

 private:
  void RemoveEarlier();

  std::filesystem::path folder_;
  bool made_folder_ = false;
  Manifest earlier_;
  Manifest written_;
};

}  // namespace corvo
