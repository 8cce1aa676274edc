// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "apps/synthetic/sequence.h"
#include "vo/camera/camera.h"
#include "vo/core/trajectory.h"

namespace corvo::bench {

/// What one camera took, and the truth.
struct Recording {
  Camera camera;
  std::vector<TimeNs> times;                ///< Ascending, one an image.
  PoseSequence truth;                       ///< Of the camera; empty where it is not known.
  std::function<cv::Mat(int index)> image;  ///< 8-bit gray, of the camera's size.

  int size() const { return static_cast<int>(times.size()); }
};

/// Where a sequence lies. Empty paths: the dataset's own calibration, no truth.
struct RecordingFiles {
  std::filesystem::path folder;
  std::filesystem::path camera;
  std::filesystem::path truth;
};

/// The first `max_count` images. Throws corvo::Error where something cannot be read, and where
/// there is no calibration.
Recording ReadRecording(const RecordingFiles& files, int max_count);

/// Renders the images when they are asked for.
Recording RenderRecording(const synthetic::Sequence& sequence);

}  // namespace corvo::bench
