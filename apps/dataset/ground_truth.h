// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "apps/dataset/pose_file.h"
#include "vo/core/trajectory.h"

namespace corvo {

/// Returns the path of a sequence's ground truth in the layout of its dataset, or an empty path if
/// there is none: KITTI `poses/XX.txt` beside `sequences/XX`; EuRoC
/// `state_groundtruth_estimate0/data.csv` and TUM-VI `mocap0/data.csv` in `mav0`, TUM-VI
/// `dso/gt_imu.csv`; KITTI raw the folder `oxts`; TartanAir `pose_left.txt`; TUM RGB-D
/// `groundtruth.txt`; TUM-mono `groundtruthSync.txt`; 7-Scenes the folder itself, which has a
/// `.pose.txt` for each frame.
std::filesystem::path FindGroundTruth(const std::filesystem::path& input);

/// Reads the ground truth poses of the camera from a file in TUM, KITTI or EuRoC format, or from
/// the
/// `.pose.txt` files of a folder in natural order of their names, which are numbered like the rows
/// of a KITTI file. EuRoC format has the poses of the body, which are transformed to cam0, see
/// ReadBodyFromCamera(). Throws corvo::Error with file and line if the file is malformed.
PoseFile ReadTruthFile(const std::filesystem::path& file);

/// Like ReadTruthFile(), but row i of a KITTI file gets the i-th of `frame_times`, which are the
/// timestamps of the whole sequence. Throws corvo::Error if their numbers differ.
PoseSequence ReadGroundTruth(const std::filesystem::path& file,
                             const std::vector<TimeNs>& frame_times);

}  // namespace corvo
