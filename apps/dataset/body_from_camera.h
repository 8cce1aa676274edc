// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/lie/se3.h"

namespace corvo {

/// Where cam0 sits on the body (the IMU) whose true poses `truth_file` holds, from the calibration
/// that lies beside it in the dataset: `T_BS` of EuRoC's `cam0/sensor.yaml`, or the inverse of
/// `T_cam_imu` of TUM-VI's `dso/camchain.yaml`. Throws corvo::Error naming the files looked for.
SE3 ReadBodyFromCamera(const std::filesystem::path& truth_file);

}  // namespace corvo
