// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>

#include "apps/synthetic/sequence.h"

namespace corvo::synthetic {

enum class Layout {
  kTum,    ///< TUM RGB-D: rgb.txt, rgb/<seconds>.png, groundtruth.txt.
  kKitti,  ///< KITTI odometry: sequences/00/{image_0/%06d.png, times.txt, calib.txt}, poses/00.txt.
  kEuroc,  ///< EuRoC: mav0/{cam0/{data/<ns>.png, data.csv, sensor.yaml},
           ///< state_groundtruth_estimate0/data.csv}.
};

/// Removes everything that WriteSequence() wrote to the folder. Files of other names stay.
void RemoveSequence(const std::filesystem::path& folder);

/// Writes the images and the ground truth of a sequence, `camera.yaml` (corvo's camera file) and
/// `synthetic.yaml` (the options of the rendering, which also marks the folder). `progress`, if
/// given, is called with the number of frames written.
///
/// A sequence that was written to the folder before is replaced, unless there are other files
/// between its own; with `force`, those stay. Otherwise the folder must be empty
/// or absent, unless `force` is set, with which files of the same names are overwritten. Throws
/// corvo::Error if the folder contains other files, if the layout cannot represent the camera, or
/// if a file cannot be written.
void WriteSequence(const Sequence& sequence, const std::filesystem::path& folder, Layout layout,
                   bool force = false, const std::function<void(int)>& progress = nullptr);

}  // namespace corvo::synthetic
