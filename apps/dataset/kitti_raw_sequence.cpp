// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "apps/dataset/kitti_raw_times.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImages = "data";

bool IsCameraFolder(const fs::path& folder) {
  return fs::is_directory(folder / kImages) && fs::exists(folder / kKittiRawTimes);
}

/// Returns the folder of a camera, or an empty path. `input` is the drive, that folder, or the
/// images in it.
fs::path CameraFolder(const fs::path& input) {
  const fs::path absolute = fs::absolute(input / "").lexically_normal().parent_path();
  if (absolute.filename() == kImages && IsCameraFolder(absolute.parent_path())) {
    return absolute.parent_path();
  }
  for (const char* name : {"image_00", "image_02", "image_01", "image_03"}) {
    if (IsCameraFolder(absolute / name)) return absolute / name;
  }
  return IsCameraFolder(absolute) && absolute.filename() != "oxts" ? absolute : fs::path();
}

}  // namespace

bool IsKittiRawSequence(const fs::path& input) { return !CameraFolder(input).empty(); }

ImageList ListKittiRawImages(const fs::path& input) {
  const fs::path folder = CameraFolder(input);
  const std::vector<fs::path> files = ImageFilesIn(folder / kImages);
  const fs::path times_file = folder / kKittiRawTimes;
  const std::vector<TimeNs> times = ReadKittiRawTimes(times_file);
  if (files.size() != times.size()) {
    throw Error(fmt::format("{}: {} timestamps for the {} images in {}", times_file.string(),
                            times.size(), files.size(), (folder / kImages).string()));
  }
  ImageList list{"kitti-raw", {}, {}};
  for (std::size_t i = 0; i < files.size(); ++i) list.images.push_back({files[i], times[i]});
  return list;
}

}  // namespace corvo
