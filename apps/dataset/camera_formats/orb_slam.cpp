// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"

namespace corvo {
namespace {

constexpr const char* kTypeKey = "Camera.type";

/// Returns the coefficients "<name>.k1", ...; those that are left out are 0.
std::vector<double> Coefficients(const DocumentFields& fields, const std::string& name,
                                 std::span<const char* const> keys) {
  std::vector<double> values;
  for (const char* key : keys) {
    values.push_back(fields.FindNumber(name + "." + key).value_or(0));
  }
  return values;
}

void SetOrbSlamDistortion(const DocumentFields& fields, const std::string& name,
                          CameraParameters& camera) {
  std::string model = fields.Text(kTypeKey);
  if (model.empty()) model = "PinHole";  // ORB-SLAM2 has no other.
  const std::string field = fields.where() + name;
  if (model == "PinHole") {
    const std::span<const char* const> keys(kOpenCvCoefficients, 8);
    SetDistortion(keys, Coefficients(fields, name, keys), field, model, camera);
  } else if (model == "KannalaBrandt8") {
    camera.model = CameraModel::kKb4;
    SetDistortion(kFisheyeCoefficients, Coefficients(fields, name, kFisheyeCoefficients), field,
                  model, camera);
  } else if (model != "Rectified") {
    ThrowUnknownModel(fields.where() + kTypeKey, model, "PinHole, KannalaBrandt8 and Rectified");
  }
}

}  // namespace

std::vector<std::string> OrbSlamCameras(const CalibrationContent& content) {
  const DocumentFields fields(content.root(), content.where());
  std::vector<std::string> names;
  for (const char* name : {"Camera", "Camera1", "Camera2"}) {
    if (fields.Has(std::string(name) + ".fx")) names.emplace_back(name);
  }
  return names;
}

StatedCamera ReadOrbSlamCamera(const CalibrationContent& content, const std::string& name) {
  const DocumentFields fields(content.root(), content.where());
  StatedCamera stated{{}, StatedFrameRate(fields, "Camera.fps"), content.where()};
  const auto number = [&](const char* key) { return fields.Number(name + key); };
  SetIntrinsics({number(".fx"), number(".fy"), number(".cx"), number(".cy")}, stated.parameters);
  if (fields.Has("Camera.width")) {
    SetSize({fields.Number("Camera.width"), fields.Number("Camera.height")},
            content.where() + "Camera", stated.parameters);
  }
  SetOrbSlamDistortion(fields, name, stated.parameters);
  return stated;
}

}  // namespace corvo
