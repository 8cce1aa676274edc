// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "apps/synthetic/sequence.h"

namespace corvo::synthetic {

/// Where an image lies in the folder of a sequence in EuRoC's layout: mav0/cam0/data/<ns>.png.
std::filesystem::path EurocImage(TimeNs time_ns);

/// Everything but the images: mav0/cam0/{data.csv, sensor.yaml} and
/// mav0/state_groundtruth_estimate0/data.csv. As in the dataset the truth is of a body whose axes
/// are not the camera's: sensor.yaml says how they lie (T_BS). Throws corvo::Error on a camera
/// other than pinhole-radtan, which sensor.yaml has no words for, and where nothing can be written.
void WriteEurocTexts(const Sequence& sequence, const std::filesystem::path& folder);

}  // namespace corvo::synthetic
