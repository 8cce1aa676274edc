// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace corvo {

/// The range of --fov, in degrees. A pinhole camera without distortion is no usable start for wider
/// lenses.
inline constexpr double kMinStatedFovDeg = 5;
inline constexpr double kMaxStatedFovDeg = 150;

/// The value of --focal with which the camera is calibrated from the images.
inline constexpr const char* kAutoFocal = "auto";

/// Throws corvo::Error unless `text`, the value of --focal, is "auto" or a number.
void CheckFocalText(const std::string& text);

/// Returns the focal length in px that --focal NUMBER or --fov states for images of this width, or
/// std::nullopt if neither does (`focal` is empty or "auto"). Throws corvo::Error if the focal
/// length is outside the range of --fov.
std::optional<double> StatedFocal(const std::string& focal, std::optional<double> fov_deg,
                                  int width);

}  // namespace corvo
