// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/core/trajectory.h"

namespace corvo {

/// The folder of the ground truth in a drive.
inline constexpr const char* kKittiRawTruth = "oxts";

/// Returns whether a folder has the form of `oxts` in a drive of KITTI's raw data: `data` with a
/// file per GPS and IMU measurement, and `timestamps.txt`.
bool IsKittiRawTruth(const std::filesystem::path& folder);

/// Reads the poses of the camera image_00 from the folder `oxts` of a drive, in m. Latitude and
/// longitude are projected by Mercator, with the scale of the first latitude (Geiger et al., Vision
/// meets Robotics: The KITTI Dataset, IJRR 2013); the world has x east, y north, z up and its
/// origin at the first measurement. The pose of the camera on the vehicle is that of
/// `calib_imu_to_velo.txt`, `calib_velo_to_cam.txt` and, if it exists, `R_rect_00` of
/// `calib_cam_to_cam.txt` beside the drive. Throws corvo::Error with file and line if a file is
/// missing or malformed.
PoseSequence ReadKittiRawTruth(const std::filesystem::path& folder);

}  // namespace corvo
