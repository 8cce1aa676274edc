// SPDX-License-Identifier: MIT
#include "apps/synthetic/euroc_layout.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/synthetic/files.h"
#include "vo/io/trajectory_io.h"

namespace corvo::synthetic {
namespace {

namespace fs = std::filesystem;

/// Returns the camera's pose on the body. The body faces along its x axis, with z up; the camera is
/// slightly in front of it and above it.
SE3 BodyFromCamera() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return SE3(SO3(rotation), Eigen::Vector3d(0.12, -0.03, 0.05));
}

std::string MatrixText(const Eigen::Matrix4d& matrix) {
  std::vector<double> entries;
  for (int i = 0; i < 16; ++i) entries.push_back(matrix(i / 4, i % 4));
  return fmt::format("[{}]", fmt::join(entries, ", "));
}

/// Returns the distortion in the format of EuRoC, or for kb4 with the name that Kalibr uses.
std::string DistortionText(const CameraParameters& camera) {
  if (camera.model == CameraModel::kKb4) {
    return fmt::format("distortion_model: equidistant\ndistortion_coefficients: [{}, {}, {}, {}]\n",
                       camera.k1, camera.k2, camera.k3, camera.k4);
  }
  std::vector<double> coefficients = {camera.k1, camera.k2, camera.p1, camera.p2};
  if (camera.k3 != 0) coefficients.push_back(camera.k3);
  return fmt::format("distortion_model: radial-tangential\ndistortion_coefficients: [{}]\n",
                     fmt::join(coefficients, ", "));
}

std::string SensorYaml(const Sequence& sequence) {
  const CameraParameters& camera = sequence.camera().parameters();
  return fmt::format(
      "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: {}\nrate_hz: {}\n"
      "resolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [{}, {}, {}, {}]\n{}",
      MatrixText(BodyFromCamera().matrix()), sequence.frame_rate_hz(), camera.width, camera.height,
      camera.fx, camera.fy, camera.cx, camera.cy, DistortionText(camera));
}

PoseSequence BodyPoses(const Sequence& sequence) {
  const SE3 camera_from_body = BodyFromCamera().Inverse();
  PoseSequence poses = sequence.poses();
  for (TimedPose& pose : poses) pose.world_from_camera = pose.world_from_camera * camera_from_body;
  return poses;
}

}  // namespace

fs::path EurocImage(TimeNs time_ns) { return fmt::format("mav0/cam0/data/{}.png", time_ns); }

void WriteEurocTexts(const Sequence& sequence, const fs::path& folder) {
  std::string images = "#timestamp [ns],filename\n";
  for (const TimedPose& pose : sequence.poses()) {
    images += fmt::format("{0},{0}.png\n", pose.time_ns);
  }
  const fs::path truth = folder / "mav0/state_groundtruth_estimate0";
  MakeFolder(folder / "mav0/cam0");
  MakeFolder(truth);
  WriteText(folder / "mav0/cam0/data.csv", images);
  WriteText(folder / "mav0/cam0/sensor.yaml", SensorYaml(sequence));
  WriteEurocPoses(truth / "data.csv", BodyPoses(sequence));
}

}  // namespace corvo::synthetic
