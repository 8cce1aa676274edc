// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "apps/synthetic/sequence.h"

namespace corvo::synthetic {

/// Returns the path of an image relative to the folder of a sequence in EuRoC's layout:
/// mav0/cam0/data/<ns>.png.
std::filesystem::path EurocImage(TimeNs time_ns);

/// Writes everything except the images: mav0/cam0/{data.csv, sensor.yaml} and
/// mav0/state_groundtruth_estimate0/data.csv. As in the dataset, the ground truth is that of a body
/// whose axes differ from the camera's; sensor.yaml has the transform between them (T_BS). The
/// camera must be pinhole-radtan or kb4, which sensor.yaml can represent. Throws corvo::Error if a
/// file cannot be written.
void WriteEurocTexts(const Sequence& sequence, const std::filesystem::path& folder);

}  // namespace corvo::synthetic
