// SPDX-License-Identifier: MIT
#include <algorithm>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"

namespace corvo {
namespace {

std::vector<DocumentFields> CamerasIn(const CalibrationContent& content) {
  return DocumentFields(content.root(), content.where()).Sections("cameras");
}

void SetDistortionOf(const DocumentFields& fields, CameraParameters& camera) {
  constexpr const char* kCoefficients = "distortion_coefficients";
  const std::string model = fields.Text("distortion_type");
  const std::vector<double> values = fields.Numbers(kCoefficients, 0, 14);
  const std::string field = fields.where() + kCoefficients;
  if (model == "equid4" || model == "equidistant" || model == "fisheye") {
    camera.model = CameraModel::kKb4;
    SetDistortion(kFisheyeCoefficients, values, field, model, camera);
  } else if (model.starts_with("radtan") || model == "plumb_bob" || values.empty()) {
    SetDistortion(kOpenCvCoefficients, values, field, model, camera);
  } else {
    ThrowUnknownModel(fields.where() + "distortion_type", model,
                      "radtan4, radtan5, plumb_bob, equid4, equidistant and fisheye");
  }
}

}  // namespace

std::vector<std::string> VslamLabCameras(const CalibrationContent& content) {
  std::vector<std::string> names;
  for (const DocumentFields& camera : CamerasIn(content)) {
    if (!camera.Has("cam_name")) return {};
    names.push_back(camera.Text("cam_name"));
  }
  return names;
}

StatedCamera ReadVslamLabCamera(const CalibrationContent& content, const std::string& name) {
  const std::vector<DocumentFields> cameras = CamerasIn(content);
  const DocumentFields& fields = *std::ranges::find_if(
      cameras, [&](const DocumentFields& camera) { return camera.Text("cam_name") == name; });
  StatedCamera stated;
  stated.where = fields.where();
  const std::string model = fields.Text("cam_model");
  if (model != "pinhole") ThrowUnknownModel(fields.where() + "cam_model", model, "pinhole");
  const std::vector<double> focal = fields.Numbers("focal_length", 2, 2);
  const std::vector<double> center = fields.Numbers("principal_point", 2, 2);
  SetIntrinsics({focal[0], focal[1], center[0], center[1]}, stated.parameters);
  SetSize(fields.Numbers("image_dimension", 2, 2), fields.where() + "image_dimension",
          stated.parameters);
  SetDistortionOf(fields, stated.parameters);
  stated.frame_rate_hz = StatedFrameRate(fields, "fps");
  return stated;
}

}  // namespace corvo
