// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/calibration_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

struct CalibrationForm {
  const char* title;
  std::vector<std::string> (*cameras)(const CalibrationContent&);
  StatedCamera (*read)(const CalibrationContent&, const std::string&);
};

/// The first form that a file has is that of the file. Tables of numbers precede documents, since
/// most of them are YAML, too.
constexpr std::array<CalibrationForm, 15> kForms = {{
    {"COLMAP cameras.bin", ColmapBinaryCameras, ReadColmapBinaryCamera},
    {"COLMAP cameras.txt", ColmapTextCameras, ReadColmapTextCamera},
    {"KITTI calib.txt and calib_cam_to_cam.txt", KittiCameras, ReadKittiCamera},
    {"TUM-mono and DSO camera.txt", DsoCameras, ReadDsoCamera},
    {"one line 'fx fy cx cy [k1 k2 p1 p2]'", OneLineCameras, ReadOneLineCamera},
    {"Kalibr camchain", KalibrCameras, ReadKalibrCamera},
    {"EuRoC sensor.yaml", EurocCameras, ReadEurocCamera},
    {"ROS camera_info", RosCameras, ReadMatrixCamera},
    {"OpenCV FileStorage (yml, xml, json)", OpenCvCameras, ReadMatrixCamera},
    {"stella_vslam settings", StellaCameras, ReadStellaCamera},
    {"ORB-SLAM2 and ORB-SLAM3 settings", OrbSlamCameras, ReadOrbSlamCamera},
    {"VSLAM-LAB calibration.yaml", VslamLabCameras, ReadVslamLabCamera},
    {"nerfstudio transforms.json", NerfstudioCameras, ReadNerfstudioCamera},
    {"JSON with fx, fy, cx, cy", PlainCameras, ReadPlainCamera},
    {"corvo's camera file", CorvoCameras, ReadCorvoCamera},
}};

std::string Join(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxNames = 10;
  const std::size_t size = std::min(kMaxNames, names.size());
  const std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + size, ", "));
  return names.size() > size ? text + ", ..." : text;
}

const std::string& Select(const std::vector<std::string>& names, const std::string& name,
                          const CalibrationContent& content) {
  if (name.empty()) return names.front();
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return *found;
  const bool is_unnamed = names.size() == 1 && names[0].empty();
  throw Error(fmt::format("{}holds no camera {}; it holds {}", content.where(), name,
                          is_unnamed ? "one camera without a name" : Join(names)));
}

}  // namespace

CalibrationFile ReadCalibrationFile(const fs::path& file, const std::string& name) {
  return ParseCalibration(ReadFileBytes(file, kMaxCalibrationBytes), file, name);
}

CalibrationFile ParseCalibration(std::string bytes, const fs::path& file, const std::string& name) {
  const CalibrationContent content(std::move(bytes), file);
  for (const CalibrationForm& form : kForms) {
    const std::vector<std::string> names = form.cameras(content);
    if (names.empty()) continue;
    const std::string selected = Select(names, name, content);
    StatedCamera camera = form.read(content, selected);
    camera.Validate();
    return {std::move(camera), selected, names};
  }
  throw Error(fmt::format("{}is no camera file of a known form; known are: {}", content.where(),
                          CalibrationForms()));
}

std::string CalibrationForms() {
  std::string text;
  for (const CalibrationForm& form : kForms) {
    text += fmt::format("{}{}", text.empty() ? "" : "; ", form.title);
  }
  return text;
}

}  // namespace corvo
