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

/// The images of one camera and the ground truth.
struct Recording {
  Camera camera;
  std::vector<TimeNs> times;                ///< Timestamps, ascending, one per image.
  PoseSequence truth;                       ///< Ground truth of the camera; empty if unknown.
  std::function<cv::Mat(int index)> image;  ///< 8-bit gray, of the camera's size.

  int size() const { return static_cast<int>(times.size()); }
};

/// The paths of a sequence. If `camera` is empty, the dataset's own calibration is used; if `truth`
/// is empty, there is no ground truth.
struct RecordingFiles {
  std::filesystem::path folder;
  std::filesystem::path camera;
  std::filesystem::path truth;
};

/// Returns the first `max_count` images. Throws corvo::Error if a file cannot be read or there is
/// no calibration.
Recording ReadRecording(const RecordingFiles& files, int max_count);

/// Returns the recording without its first `start` images. Throws corvo::Error unless one is left.
Recording StartAt(const Recording& recording, int start);

/// Returns a recording whose images are rendered on each access.
Recording RenderRecording(const synthetic::Sequence& sequence);

}  // namespace corvo::bench
