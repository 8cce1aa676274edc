// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/camera/camera.h"

namespace corvo {

/// Reads the `camera.txt` of a TUM-mono sequence: "fx fy cx cy omega", in units of the image's
/// width and height with the origin at its corner, followed by a line "width height". Further
/// lines, for rectification, are ignored. Throws corvo::Error with file, line and value if it is
/// malformed.
CameraParameters ReadTumMonoCamera(const std::filesystem::path& file);

}  // namespace corvo
