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

// Configuration files are YAML and are read strictly: an unknown key, a key given twice, or a value
// of the wrong type or out of range raises a corvo::Error that names file, line and key (and for an
// unknown key the nearest known one).

/// Reads options from a file. Keys that the file leaves out keep their defaults.
OdometryOptions ReadOptions(const std::filesystem::path& file);

/// Like ReadOptions(), for the content of a file. `file` is for messages.
OdometryOptions ParseOptions(const std::string& text, const std::filesystem::path& file);

/// Returns the text of a file that ReadOptions() reads back unchanged: every key, each with its
/// meaning and range as a comment.
std::string WriteOptions(const OdometryOptions& options);

/// The range of the frame rate that a camera file states, Hz.
inline constexpr double kMinFrameRateHz = 1e-3;
inline constexpr double kMaxFrameRateHz = 1e5;

/// The contents of a camera file.
struct CameraFile {
  Camera camera;
  std::optional<double> frame_rate_hz;
  std::string source;  ///< Origin of the numbers; may be empty.
  /// Standard deviations of parameters; those that are not named are exact. std::nullopt if the
  /// file does not state any.
  std::optional<std::vector<FreeParameter>> sigma;

  /// Returns the prior that the file states or, if it states none, that of MakePrior().
  CameraPrior Prior(const CalibrationOptions& options) const;
};

/// Reads a camera file. Keys: model (pinhole-radtan, kb4 or fov), width, height, fx, fy, cx, cy,
/// all required; the model's distortion (pinhole-radtan: k1, k2, p1, p2, k3; kb4: k1, k2, k3, k4;
/// fov: omega), 0 if left out; frame_rate_hz and source, optional; sigma, optional: standard
/// deviations of any of fx, fy, cx, cy and the distortion, in their own units, or of focal, which
/// is fx and fy together, as a share of them.
CameraFile ReadCameraFile(const std::filesystem::path& file);

/// Like ReadCameraFile(), for the content of a file. `file` is for messages.
CameraFile ParseCameraFile(const std::string& text, const std::filesystem::path& file);

/// Returns the text of a file that ReadCameraFile() reads back unchanged.
std::string WriteCameraFile(const CameraFile& camera_file);

}  // namespace corvo
