// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/dataset/gray_levels.h"
#include "apps/dataset/image_list.h"
#include "apps/export/reconstruction.h"
#include "apps/output/map_ply.h"
#include "apps/output/observation_table.h"

namespace corvo {

/// A row of frames.csv with the pose of the frame.
struct ResultFrame {
  int index = 0;
  std::string image;  ///< As in frames.csv.
  bool is_keyframe = false;
  int segment = kNoId;
  std::optional<SE3> world_from_camera;
};

/// What `corvo run` has written into a folder.
struct RunResult {
  CameraParameters camera;             ///< Of the processed images.
  std::filesystem::path image_folder;  ///< Folder of image files; empty for others.
  std::filesystem::path video;         ///< The video or bag; empty for image files and cameras.
  InputOptions stored;                 ///< How the images were read.
  GrayLevels gray_levels;              ///< How 16-bit images became 8-bit ones.
  std::vector<ResultFrame> frames;
  std::vector<MapPoint> points;
  std::vector<ObservationRow> observations;
};

/// Reads the result of a run. Throws corvo::Error if a file is missing or damaged, or if the run
/// was made by a version that did not write all of them.
RunResult ReadRunResult(const std::filesystem::path& folder);

/// Which frames are exported.
enum class ExportedFrames { kKeyframes, kAll };

/// Returns the segments in descending order of their numbers of posed frames.
std::vector<int> SegmentsBySize(const RunResult& result);

/// Returns the posed frames of a segment, in their order, and its points with their observations.
/// Images of a video or bag are called "frame_<index>.jpg", with six digits.
Reconstruction MakeReconstruction(const RunResult& result, int segment, ExportedFrames frames);

}  // namespace corvo
