// SPDX-License-Identifier: MIT
#include "apps/dataset/body_from_camera.h"

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/dataset/camera_formats/document.h"
#include "orb/error.h"
#include "vo/core/trajectory.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns the numbers of a list, or of a list of lists.
std::vector<double> Flatten(const YAML::Node& node) {
  std::vector<double> numbers;
  for (const YAML::Node& entry : node) {
    if (!entry.IsSequence()) {
      numbers.push_back(entry.as<double>());
      continue;
    }
    for (const YAML::Node& number : entry) numbers.push_back(number.as<double>());
  }
  return numbers;
}

SE3 ParseTransform(const YAML::Node& node, const char* key) {
  const std::vector<double> numbers = Flatten(node);
  if (numbers.size() != 16) {
    throw Error(fmt::format("{} has {} numbers; a 4x4 matrix has 16", key, numbers.size()));
  }
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(numbers.data());
  const SE3 pose(SO3(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())), matrix.topRightCorner<3, 1>());
  CheckPose(key, pose);
  return pose;
}

/// Returns std::nullopt if the file has no T_BS.
std::optional<SE3> ParseSensor(const YAML::Node& root) {
  const YAML::Node node = root["T_BS"];
  if (!node) return std::nullopt;
  return ParseTransform(node.IsMap() ? node["data"] : node, "T_BS");
}

/// Parses a camchain.yaml as written by Kalibr. Returns std::nullopt if it has no T_cam_imu.
std::optional<SE3> ParseCameraChain(const YAML::Node& root) {
  const YAML::Node camera = root["cam0"];
  if (!camera || !camera["T_cam_imu"]) return std::nullopt;
  return ParseTransform(camera["T_cam_imu"], "T_cam_imu").Inverse();
}

/// Returns std::nullopt if the file does not exist or does not contain the transform.
std::optional<SE3> ReadTransform(const fs::path& file,
                                 std::optional<SE3> (*parse)(const YAML::Node&)) {
  if (!fs::exists(file)) return std::nullopt;
  const YAML::Node root = ReadDocument(file);
  try {
    return parse(root);
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

SE3 ReadBodyFromCamera(const fs::path& truth_file) {
  const fs::path folder = fs::absolute(truth_file).parent_path();
  const fs::path above = folder.parent_path();
  const fs::path sensor = above / "cam0" / "sensor.yaml";
  if (const auto found = ReadTransform(sensor, ParseSensor)) return *found;
  for (const fs::path& chain :
       {folder / "camchain.yaml", above.parent_path() / "dso" / "camchain.yaml"}) {
    if (const auto found = ReadTransform(chain, ParseCameraChain)) return *found;
  }
  throw Error(
      fmt::format("{}: contains poses of the body, but the pose of the camera on the body is "
                  "unknown: there is neither T_BS in {} nor T_cam_imu in a camchain.yaml",
                  truth_file.string(), sensor.string()));
}

}  // namespace corvo
