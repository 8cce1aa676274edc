// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "apps/dataset/image_header.h"
#include "apps/dataset/image_layouts.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/file_bytes.h"
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
    {{"image_0", "P0:"}, {"image_2", "P2:"}, {"image_1", "P1:"}, {"image_3", "P3:"}}};

const RigCamera* FindCamera(const fs::path& input) {
  for (const RigCamera& camera : kCameras) {
    if (fs::is_directory(input / camera.folder)) return &camera;
  }
  return nullptr;
}

/// Appends images with the times in the lines of a file.
void AddListedTimes(const std::vector<fs::path>& files, const fs::path& times, ImageList& list) {
  const std::vector<TextLine> lines = ReadTableLines(times);
  if (files.size() != lines.size()) {
    throw Error(fmt::format("{}: {} timestamps for the {} images in {}", times.string(),
                            lines.size(), files.size(), files.front().parent_path().string()));
  }
  const TimeUnit unit = GuessTimeUnit(lines[0].text);
  for (std::size_t i = 0; i < files.size(); ++i) {
    list.images.push_back({files[i], ParseTime(lines[i].text, unit, LinePrefix(times, lines[i]))});
  }
}

/// Parses the 3x4 projection matrix of a row, row-major: [fx 0 cx . ; 0 fy cy . ; 0 0 1 .].
CameraParameters ParseProjection(const std::vector<std::string>& fields, const std::string& where) {
  if (fields.size() != 13) {
    throw Error(fmt::format("{}{} values after {}; a projection matrix has 12", where,
                            fields.size() - 1, fields[0]));
  }
  CameraParameters camera;
  camera.fx = ParseNumber(fields[1], where);
  camera.cx = ParseNumber(fields[3], where);
  camera.fy = ParseNumber(fields[6], where);
  camera.cy = ParseNumber(fields[7], where);
  return camera;
}

void ValidateCamera(const CameraParameters& camera, const std::string& where) {
  try {
    camera.Validate();
  } catch (const Error& error) {
    throw Error(where + error.what());
  }
}

/// Reads the camera in `row`. The file does not contain the image size, which is taken from
/// `first_image`.
CameraParameters ReadCamera(const fs::path& file, const char* row, const fs::path& first_image) {
  for (const TextLine& line : ReadTextLines(file)) {
    const std::vector<std::string> fields = SplitFields(line.text);
    if (fields.front() != row) continue;
    CameraParameters camera = ParseProjection(fields, LinePrefix(file, line));
    const auto image = ParseImageHeader(ReadFileBytes(first_image, kMaxImageBytes));
    if (!image) throw Error(fmt::format("{}: not a readable image", first_image.string()));
    camera.width = static_cast<int>(image->width);
    camera.height = static_cast<int>(image->height);
    ValidateCamera(camera, LinePrefix(file, line));
    return camera;
  }
  throw Error(fmt::format("{}: has no row {}", file.string(), row));
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
  if (fs::exists(input / kCalibration)) {
    list.camera = ReadCamera(input / kCalibration, rig_camera.row, files.front());
  }
  return list;
}

}  // namespace corvo
