// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "apps/dataset/dataset_camera.h"
#include "apps/dataset/image_layouts.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTimes = "times.txt";
constexpr const char* kCalibration = "calib.txt";

/// A camera of the rig: its image folder and its row in calib.txt.
struct RigCamera {
  const char* folder;
  const char* row;
};

/// The cameras in order of preference: left gray, left color, right gray, right color.
constexpr std::array<RigCamera, 4> kCameras = {
    {{"image_0", "P0"}, {"image_2", "P2"}, {"image_1", "P1"}, {"image_3", "P3"}}};

const RigCamera* FindCamera(const fs::path& input) {
  for (const RigCamera& camera : kCameras) {
    if (fs::is_directory(input / camera.folder)) return &camera;
  }
  return nullptr;
}

/// Appends images with the times in the lines of a file.
void AddListedTimes(const std::vector<fs::path>& files, const fs::path& times, ImageList& list) {
  const std::vector<TextLine> lines = ReadTableLines(times);
  CheckNumTimes(times, lines.size(), files.front().parent_path(), files.size());
  const TimeUnit unit = GuessTimeUnit(lines[0].text);
  for (std::size_t i = 0; i < files.size(); ++i) {
    list.images.push_back({files[i], ParseTime(lines[i].text, unit, LinePrefix(times, lines[i]))});
  }
}

}  // namespace

bool IsKittiSequence(const fs::path& input) {
  return (fs::exists(input / kTimes) || fs::exists(input / kCalibration)) &&
         FindCamera(input) != nullptr;
}

ImageList ListKittiImages(const fs::path& input, const InputOptions& options) {
  const RigCamera& rig_camera = *FindCamera(input);
  const fs::path folder = input / rig_camera.folder;
  const std::vector<fs::path> files = ImageFilesIn(folder);
  if (files.empty()) throw Error(fmt::format("{}: contains no images", folder.string()));
  ImageList list{"kitti", {}, {}};
  if (fs::exists(input / kTimes)) {
    AddListedTimes(files, input / kTimes, list);
  } else {
    AddIndexTimes(files, options, list);
  }
  if (options.reads_camera && fs::exists(input / kCalibration)) {
    list.camera = ReadDatasetCamera(input / kCalibration, rig_camera.row, files.front());
  }
  return list;
}

}  // namespace corvo
