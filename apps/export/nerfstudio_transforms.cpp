// SPDX-License-Identifier: MIT
#include "apps/export/nerfstudio_transforms.h"

#include "orb/error.h"

namespace corvo {
namespace {

/// Returns the rotation between OpenGL's camera axes and those of computer vision (x right, y down,
/// z forward).
SO3 VisionFromOpenGl() {
  return SO3(Eigen::Quaterniond(0, 1, 0, 0));  // 180° about x.
}

nlohmann::ordered_json Matrix(const SE3& pose) {
  const Eigen::Matrix3d r = pose.rotation().matrix();
  const Eigen::Vector3d& t = pose.translation();
  auto rows = nlohmann::ordered_json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({r(i, 0), r(i, 1), r(i, 2), t[i]});
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

void AddIntrinsics(const CameraParameters& camera, nlohmann::ordered_json& json) {
  if (camera.model == CameraModel::kFov) {
    throw Error("transforms.json cannot hold a camera of the model fov; use --undistort");
  }
  json["camera_model"] = camera.model == CameraModel::kKb4 ? "OPENCV_FISHEYE" : "OPENCV";
  json["w"] = camera.width;
  json["h"] = camera.height;
  json["fl_x"] = camera.fx;
  json["fl_y"] = camera.fy;
  json["cx"] = camera.cx + 0.5;
  json["cy"] = camera.cy + 0.5;
  json["k1"] = camera.k1;
  json["k2"] = camera.k2;
  json["k3"] = camera.k3;
  json["k4"] = camera.k4;
  json["p1"] = camera.p1;
  json["p2"] = camera.p2;
}

}  // namespace

SO3 TransformsFromWorld(const Reconstruction& reconstruction) {
  if (reconstruction.images.empty()) return SO3();
  const SO3& first = reconstruction.images.front().world_from_camera.rotation();
  const Eigen::Vector3d up_in_world = first * Eigen::Vector3d(0, -1, 0);
  return SO3(Eigen::Quaterniond::FromTwoVectors(up_in_world, Eigen::Vector3d::UnitZ()));
}

nlohmann::ordered_json ToTransforms(const Reconstruction& reconstruction,
                                    const std::string& image_folder, const std::string& ply_file) {
  nlohmann::ordered_json json;
  AddIntrinsics(reconstruction.camera, json);
  json["ply_file_path"] = ply_file;
  json["frames"] = nlohmann::ordered_json::array();
  const SE3 transforms_from_world(TransformsFromWorld(reconstruction), Eigen::Vector3d::Zero());
  const SE3 vision_from_opengl(VisionFromOpenGl(), Eigen::Vector3d::Zero());
  int id = 0;
  for (const ReconstructedImage& image : reconstruction.images) {
    const SE3 pose = transforms_from_world * image.world_from_camera * vision_from_opengl;
    json["frames"].push_back({{"file_path", image_folder + "/" + image.name},
                              {"transform_matrix", Matrix(pose)},
                              {"colmap_im_id", ++id}});
  }
  return json;
}

}  // namespace corvo
