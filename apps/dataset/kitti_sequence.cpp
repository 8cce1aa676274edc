// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <fmt/format.h>

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

/// The cameras in order of preference: left gray, left color.
constexpr std::array<RigCamera, 2> kCameras = {{{"image_0", "P0:"}, {"image_2", "P2:"}}};

const RigCamera* FindCamera(const fs::path& input) {
  for (const RigCamera& camera : kCameras) {
    if (fs::is_directory(input / camera.folder)) return &camera;
  }
  return nullptr;
}

std::vector<TimeNs> ReadTimes(const fs::path& file) {
  std::vector<TimeNs> times;
  const std::vector<TextLine> lines = ReadTableLines(file);
  for (const TextLine& line : lines) {
    const TimeUnit unit = GuessTimeUnit(lines[0].text);
    times.push_back(ParseTime(line.text, unit, LinePrefix(file, line)));
  }
  return times;
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
    const cv::Mat image = ReadGrayImage(first_image);
    camera.width = image.cols;
    camera.height = image.rows;
    ValidateCamera(camera, LinePrefix(file, line));
    return camera;
  }
  throw Error(fmt::format("{}: has no row {}", file.string(), row));
}

}  // namespace

bool IsKittiSequence(const fs::path& input) {
  return fs::exists(input / kTimes) && FindCamera(input) != nullptr;
}

ImageList ListKittiImages(const fs::path& input) {
  const RigCamera& rig_camera = *FindCamera(input);
  const fs::path folder = input / rig_camera.folder;
  const std::vector<fs::path> files = ImageFilesIn(folder);
  const std::vector<TimeNs> times = ReadTimes(input / kTimes);
  if (files.empty()) throw Error(fmt::format("{}: contains no images", folder.string()));
  if (files.size() != times.size()) {
    throw Error(fmt::format("{}: {} timestamps for the {} images in {}", (input / kTimes).string(),
                            times.size(), files.size(), folder.string()));
  }
  ImageList list{"kitti", {}, {}};
  for (std::size_t i = 0; i < files.size(); ++i) list.images.push_back({files[i], times[i]});
  if (fs::exists(input / kCalibration)) {
    list.camera = ReadCamera(input / kCalibration, rig_camera.row, files.front());
  }
  return list;
}

}  // namespace corvo
