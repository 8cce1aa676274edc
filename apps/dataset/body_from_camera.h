// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/lie/se3.h"

namespace corvo {

/// Returns the pose of cam0 in the frame of the body (the IMU), whose ground truth is `truth_file`,
/// from the calibration in the same dataset: `T_BS` of EuRoC's `cam0/sensor.yaml`, or the inverse
/// of `T_cam_imu` of TUM-VI's `dso/camchain.yaml`. Throws corvo::Error with the expected files if
/// there is none.
SE3 ReadBodyFromCamera(const std::filesystem::path& truth_file);

}  // namespace corvo
