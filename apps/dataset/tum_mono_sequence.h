// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/camera/camera.h"

namespace corvo {

/// The `camera.txt` of a TUM-mono sequence: "fx fy cx cy omega", in units of the image's width
/// and height with the origin at its corner, and below it "width height". What follows (how to
/// rectify) is left out. Throws corvo::Error naming file, line and value.
CameraParameters ReadTumMonoCamera(const std::filesystem::path& file);

}  // namespace corvo
