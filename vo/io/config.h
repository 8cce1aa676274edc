// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"

namespace corvo {

// Configuration files are YAML, and strict: an unknown key, a key given twice, a value of the wrong
// type or out of range is a corvo::Error that names file, line and key (and for an unknown key the
// nearest known one).

/// Keys that the file leaves out keep their defaults.
OdometryOptions ReadOptions(const std::filesystem::path& file);

/// The text of a file that ReadOptions() reads back the same: every key, each with its meaning and
/// range as a comment.
std::string WriteOptions(const OdometryOptions& options);

/// A camera, and what its file says besides.
struct CameraFile {
  Camera camera;
  std::optional<double> frame_rate_hz;
  std::string source;  ///< Where the numbers come from; may be empty.
  /// How surely they are known: what is not named is exact. None: it is not said.
  std::optional<std::vector<FreeParameter>> sigma;

  /// What the file says of its sigmas or, if it does not, what MakePrior assumes.
  CameraPrior Prior(const CalibrationOptions& options) const;
};

/// Keys: model (pinhole-radtan, kb4 or fov), width, height, fx, fy, cx, cy, all needed; the model's
/// distortion (pinhole-radtan: k1, k2, p1, p2, k3; kb4: k1, k2, k3, k4; fov: omega), 0 if left out;
/// frame_rate_hz and source, optional; sigma, optional: standard deviations of any of fx, fy, cx,
/// cy and the distortion, in their own units, or of focal, of fx and fy together as a share of
/// them.
CameraFile ReadCameraFile(const std::filesystem::path& file);

/// The text of a file that ReadCameraFile() reads back the same.
std::string WriteCameraFile(const CameraFile& camera_file);

}  // namespace corvo
