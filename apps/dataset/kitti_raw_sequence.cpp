// SPDX-License-Identifier: MIT
#include <optional>
#include <string>
#include <string_view>

#include "apps/dataset/dataset_camera.h"
#include "apps/dataset/image_header.h"
#include "apps/dataset/image_layouts.h"
#include "apps/dataset/kitti_raw_times.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRawImages = "data";
constexpr std::string_view kPrefix = "image_";

bool IsRawCameraFolder(const fs::path& folder) {
  return folder.filename().string().starts_with(kPrefix) && fs::is_directory(folder / kRawImages) &&
         fs::exists(folder / kKittiRawTimes);
}

/// Returns the folder of a camera, or an empty path. `input` is the drive, that folder, or the
/// images in it.
fs::path RawCameraFolder(const fs::path& input) {
  const fs::path absolute = AbsoluteFolder(input);
  if (absolute.filename() == kRawImages && IsRawCameraFolder(absolute.parent_path())) {
    return absolute.parent_path();
  }
  for (const char* name : {"image_00", "image_02", "image_01", "image_03"}) {
    if (IsRawCameraFolder(absolute / name)) return absolute / name;
  }
  return IsRawCameraFolder(absolute) ? absolute : fs::path();
}

/// Reads the camera of a folder, rectified or, if only those images have its size, raw. Returns
/// std::nullopt if there is no calibration beside the drive.
std::optional<CameraParameters> FindRawCamera(const fs::path& folder, const fs::path& first_image) {
  const fs::path file = folder.parent_path().parent_path() / "calib_cam_to_cam.txt";
  if (!fs::exists(file)) return std::nullopt;
  const std::string number = folder.filename().string().substr(kPrefix.size());
  const CameraParameters rectified = ReadDatasetCamera(file, "P_rect_" + number, first_image);
  const ImageHeader image = ReadImageHeader(first_image);
  const auto fits = [&](const CameraParameters& camera) {
    return camera.width == image.width && camera.height == image.height;
  };
  if (fits(rectified)) return rectified;
  const CameraParameters raw = ReadDatasetCamera(file, "K_" + number, first_image);
  return fits(raw) ? raw : rectified;
}

}  // namespace

bool IsKittiRawSequence(const fs::path& input) { return !RawCameraFolder(input).empty(); }

ImageList ListKittiRawImages(const fs::path& input, const InputOptions& options) {
  const fs::path folder = RawCameraFolder(input);
  const std::vector<fs::path> files = ImageFilesIn(folder / kRawImages);
  const fs::path times_file = folder / kKittiRawTimes;
  const std::vector<TimeNs> times = ReadKittiRawTimes(times_file);
  CheckNumTimes(times_file, times.size(), folder / kRawImages, files.size());
  ImageList list{"kitti-raw", {}, {}};
  AddTimedImages(files, times, list);
  if (options.reads_camera && !files.empty()) list.camera = FindRawCamera(folder, files.front());
  return list;
}

}  // namespace corvo
