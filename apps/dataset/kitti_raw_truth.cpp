// SPDX-License-Identifier: MIT
#include "apps/dataset/kitti_raw_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "apps/dataset/image_files.h"
#include "apps/dataset/kitti_raw_times.h"
#include "orb/error.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns the numbers of the row `name` ("R:") of a calibration file, of which it has `count`.
std::vector<double> ReadRow(const fs::path& file, const std::string& name, std::size_t count) {
  for (const TextLine& line : ReadTextLines(file)) {
    const std::vector<std::string> fields = SplitFields(line.text);
    if (fields.front() != name) continue;
    const std::string where = LinePrefix(file, line);
    if (fields.size() != count + 1) {
      throw Error(fmt::format("{}{} values after {}; needed are {}", where, fields.size() - 1, name,
                              count));
    }
    std::vector<double> numbers;
    for (std::size_t i = 1; i <= count; ++i) numbers.push_back(ParseNumber(fields[i], where));
    return numbers;
  }
  throw Error(fmt::format("{}: has no row {}", file.string(), name));
}

SO3 ReadRotation(const fs::path& file, const std::string& name) {
  const std::vector<double> numbers = ReadRow(file, name, 9);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> matrix(numbers.data());
  if (!(std::abs(matrix.determinant() - 1) < 1e-2)) {
    throw Error(fmt::format("{}: {} is not a rotation matrix", file.string(), name));
  }
  return SO3(Eigen::Matrix3d(matrix));
}

/// Reads a transform from the rows R and T.
SE3 ReadTransform(const fs::path& file) {
  const std::vector<double> t = ReadRow(file, "T:", 3);
  return {ReadRotation(file, "R:"), {t[0], t[1], t[2]}};
}

/// Returns the pose of the rectified camera 0 in the frame of the IMU.
SE3 ReadImuFromCamera(const fs::path& calibration) {
  const SE3 velo_from_imu = ReadTransform(calibration / "calib_imu_to_velo.txt");
  SE3 camera_from_velo = ReadTransform(calibration / "calib_velo_to_cam.txt");
  const fs::path cameras = calibration / "calib_cam_to_cam.txt";
  if (fs::exists(cameras)) {
    camera_from_velo =
        SE3(ReadRotation(cameras, "R_rect_00:"), Eigen::Vector3d::Zero()) * camera_from_velo;
  }
  return (camera_from_velo * velo_from_imu).Inverse();
}

/// A measurement: position as latitude and longitude in degrees and altitude in m; roll, pitch and
/// yaw in rad, yaw from the east.
using Measurement = std::array<double, 6>;

Measurement ReadMeasurement(const fs::path& file) {
  const std::vector<TextLine> lines = ReadTextLines(file);
  if (lines.empty()) throw Error(fmt::format("{}: is empty", file.string()));
  const std::string where = LinePrefix(file, lines[0]);
  const std::vector<std::string> fields = SplitFields(lines[0].text);
  Measurement values;
  if (fields.size() < values.size()) {
    throw Error(
        fmt::format("{}{} values; needed are latitude, longitude, altitude, roll, pitch, "
                    "yaw",
                    where, fields.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = ParseNumber(fields[i], where);
  CheckRange(where + "latitude", values[0], -89.0, 89.0);
  return values;
}

/// Returns the position in the projection by Mercator.
Eigen::Vector3d Project(const Measurement& m, double mercator_scale) {
  constexpr double kEarthRadius = 6378137;  // m, equatorial.
  constexpr double kRadians = std::numbers::pi / 180;
  const double r = mercator_scale * kEarthRadius;
  return {r * kRadians * m[1], r * std::log(std::tan((90 + m[0]) * kRadians / 2)), m[2]};
}

SO3 Rotation(const Measurement& m) {
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(m[5], Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(m[4], Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(m[3], Eigen::Vector3d::UnitX());
  return SO3(rotation.toRotationMatrix());
}

/// Returns the measurements of a folder in the order of their names.
std::vector<Measurement> ReadMeasurements(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".txt") files.push_back(entry.path());
  }
  SortByName(files);
  std::vector<Measurement> measurements;
  for (const fs::path& file : files) measurements.push_back(ReadMeasurement(file));
  return measurements;
}

}  // namespace

bool IsKittiRawTruth(const fs::path& folder) {
  return fs::is_directory(folder / "data") && fs::exists(folder / kKittiRawTimes);
}

PoseSequence ReadKittiRawTruth(const fs::path& folder) {
  const fs::path drive = AbsoluteFolder(folder).parent_path();
  const SE3 imu_from_camera = ReadImuFromCamera(drive.parent_path());
  const std::vector<TimeNs> times = ReadKittiRawTimes(folder / kKittiRawTimes);
  const std::vector<Measurement> measurements = ReadMeasurements(folder / "data");
  if (measurements.size() != times.size()) {
    throw Error(fmt::format("{}: {} timestamps for {} measurements",
                            (folder / kKittiRawTimes).string(), times.size(), measurements.size()));
  }
  PoseSequence poses;
  if (measurements.empty()) return poses;
  const double scale = std::cos(measurements[0][0] * std::numbers::pi / 180);
  const Eigen::Vector3d origin = Project(measurements[0], scale);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Eigen::Vector3d moved = Project(measurements[i], scale) - origin;
    poses.push_back({times[i], SE3(Rotation(measurements[i]), moved) * imu_from_camera});
  }
  return poses;
}

}  // namespace corvo
