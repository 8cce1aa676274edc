// SPDX-License-Identifier: MIT
#include <algorithm>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"

namespace corvo {
namespace {

// The values of Kalibr's and EuRoC's files are the same but for the key of the distortion and the
// name of its model.
constexpr const char* kKalibrDistortion = "distortion_coeffs";
constexpr const char* kEurocDistortion = "distortion_coefficients";

void SetKalibrDistortion(const DocumentFields& fields, const std::string& key,
                         CameraParameters& camera) {
  const std::string model = fields.Text("distortion_model");
  const std::string field = fields.where() + key;
  if (model == "radial-tangential" || model == "radtan") {
    SetDistortion(kOpenCvCoefficients, fields.Numbers(key, 4, 5), field, model, camera);
  } else if (model == "equidistant") {
    camera.model = CameraModel::kKb4;
    SetDistortion(kFisheyeCoefficients, fields.Numbers(key, 4, 4), field, model, camera);
  } else if (model == "fov") {
    camera.model = CameraModel::kFov;
    SetDistortion(kFovCoefficients, fields.Numbers(key, 1, 1), field, model, camera);
  } else if (model != "none") {
    ThrowUnknownModel(fields.where() + "distortion_model", model,
                      "radial-tangential (radtan), equidistant, fov and none");
  }
}

StatedCamera ReadSensor(const DocumentFields& fields, const std::string& distortion_key) {
  StatedCamera stated;
  const std::string model = fields.Text("camera_model");
  if (model != "pinhole") ThrowUnknownModel(fields.where() + "camera_model", model, "pinhole");
  SetSize(fields.Numbers("resolution", 2, 2), fields.where() + "resolution", stated.parameters);
  SetIntrinsics(fields.Numbers("intrinsics", 4, 4), stated.parameters);
  SetKalibrDistortion(fields, distortion_key, stated.parameters);
  stated.frame_rate_hz = StatedFrameRate(fields, "rate_hz");
  stated.where = fields.where();
  return stated;
}

bool IsCameraName(const std::string& key) {
  constexpr std::string_view kPrefix = "cam";
  return key.size() > kPrefix.size() && key.starts_with(kPrefix) &&
         key.find_first_not_of("0123456789", kPrefix.size()) == std::string::npos;
}

}  // namespace

std::vector<std::string> KalibrCameras(const CalibrationContent& content) {
  std::vector<std::string> names = KeysOf(content.root());
  std::erase_if(names, [](const std::string& key) { return !IsCameraName(key); });
  return names;
}

StatedCamera ReadKalibrCamera(const CalibrationContent& content, const std::string& name) {
  return ReadSensor(DocumentFields(content.root(), content.where()).Section(name),
                    kKalibrDistortion);
}

std::vector<std::string> EurocCameras(const CalibrationContent& content) {
  const DocumentFields fields(content.root(), content.where());
  const bool is_sensor =
      fields.Has("camera_model") && (fields.Has("intrinsics") || fields.Has("resolution"));
  if (!is_sensor) return {};
  return {""};
}

StatedCamera ReadEurocCamera(const CalibrationContent& content, const std::string& /*name*/) {
  return ReadSensor({content.root(), content.where()}, kEurocDistortion);
}

}  // namespace corvo
