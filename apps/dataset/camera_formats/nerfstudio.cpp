// SPDX-License-Identifier: MIT
#include <algorithm>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"

namespace corvo {
namespace {

constexpr const char* kCameraModel = "camera_model";
constexpr const char* kCoefficients[] = {"k1", "k2", "k3", "k4", "p1", "p2"};

CameraModel ReadModel(const DocumentFields& fields) {
  const std::string model = fields.Text(kCameraModel);
  if (model == "OPENCV_FISHEYE") return CameraModel::kKb4;
  const bool is_pinhole =
      model.empty() || model == "OPENCV" || model == "PINHOLE" || model == "SIMPLE_PINHOLE";
  if (is_pinhole) return CameraModel::kPinhole;
  ThrowUnknownModel(fields.where() + kCameraModel, model, "OPENCV, PINHOLE and OPENCV_FISHEYE");
}

}  // namespace

std::vector<std::string> NerfstudioCameras(const CalibrationContent& content) {
  const DocumentFields fields(content.root(), content.where());
  const bool is_transforms =
      fields.Has("fl_x") || fields.Has("camera_angle_x") || fields.Has("applied_transform");
  if (!is_transforms) return {};
  return {""};
}

StatedCamera ReadNerfstudioCamera(const CalibrationContent& content, const std::string& /*name*/) {
  const DocumentFields fields(content.root(), content.where());
  StatedCamera stated{{}, {}, content.where()};
  CameraParameters& camera = stated.parameters;
  camera.model = ReadModel(fields);
  SetSize({fields.Number("w"), fields.Number("h")}, content.where() + "w, h", camera);
  const double fx = fields.Number("fl_x");
  // The center of the first pixel is (0.5, 0.5).
  SetIntrinsics({fx, fields.FindNumber("fl_y").value_or(fx),
                 fields.FindNumber("cx").value_or(0.5 * camera.width) - 0.5,
                 fields.FindNumber("cy").value_or(0.5 * camera.height) - 0.5},
                camera);
  std::vector<double> values;
  for (const char* key : kCoefficients) values.push_back(fields.FindNumber(key).value_or(0));
  const std::string model = fields.Has(kCameraModel) ? fields.Text(kCameraModel) : "OPENCV";
  SetDistortion(kCoefficients, values, content.where() + "distortion", model, camera);
  return stated;
}

}  // namespace corvo
