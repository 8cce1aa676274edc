// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "apps/dataset/pose_file.h"
#include "vo/core/trajectory.h"

namespace corvo {

/// Where a sequence's ground truth lies in its dataset's layout: KITTI `poses/XX.txt` beside
/// `sequences/XX`; EuRoC `state_groundtruth_estimate0/data.csv` and TUM-VI `mocap0/data.csv` in
/// `mav0`, TUM-VI `dso/gt_imu.csv`; TUM RGB-D `groundtruth.txt`; TUM-mono `groundtruthSync.txt`;
/// 7-Scenes the folder itself, with a `.pose.txt` for each frame. Empty if there is none.
std::filesystem::path FindGroundTruth(const std::filesystem::path& input);

/// The camera's true poses, from a file in TUM, KITTI or EuRoC format, or from the `.pose.txt`
/// files of a folder in the order of their names, which are numbered as the rows of a KITTI file.
/// EuRoC's format gives the body's poses: they are moved to cam0 by `T_BS` of `cam0/sensor.yaml`,
/// or TUM-VI's `T_cam_imu` of `dso/camchain.yaml`, found from the file's place in the dataset.
/// Throws corvo::Error naming file and line.
PoseFile ReadTruthFile(const std::filesystem::path& file);

/// As ReadTruthFile; row i of a KITTI file has the i-th of `frame_times`, which are those of the
/// whole sequence. Throws corvo::Error naming both counts where they differ.
PoseSequence ReadGroundTruth(const std::filesystem::path& file,
                             const std::vector<TimeNs>& frame_times);

}  // namespace corvo
