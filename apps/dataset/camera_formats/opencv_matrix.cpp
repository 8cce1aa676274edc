// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"

namespace corvo {
namespace {

// The keys of OpenCV's samples and applications in their versions.
constexpr DocumentFields::Keys kMatrix = {"camera_matrix", "cameraMatrix", "Camera_Matrix"};
constexpr DocumentFields::Keys kCoefficientKeys = {"distortion_coefficients",
                                                   "dist_coeffs",
                                                   "Distortion_Coefficients",
                                                   "distCoeffs",
                                                   "distortionCoefficients",
                                                   "dist_coeff",
                                                   "dist_coefs"};
constexpr DocumentFields::Keys kImageWidth = {"image_width", "image_Width", "width"};
constexpr DocumentFields::Keys kImageHeight = {"image_height", "image_Height", "height"};
constexpr DocumentFields::Keys kSize = {"cameraResolution", "image_size", "imageSize"};
constexpr const char* kDistortionModel = "distortion_model";

DocumentFields FieldsOf(const CalibrationContent& content) {
  return {content.root(), content.where()};
}

bool HasMatrix(const DocumentFields& fields) { return fields.Has(fields.FirstOf(kMatrix)); }

void SetSizeOf(const DocumentFields& fields, CameraParameters& camera) {
  const std::string size = fields.FirstOf(kSize);
  const std::string width = fields.FirstOf(kImageWidth);
  if (fields.Has(size)) {
    SetSize(fields.Numbers(size, 2, 2), fields.where() + size, camera);
  } else if (fields.Has(width)) {
    const double height = fields.Number(fields.FirstOf(kImageHeight));
    SetSize({fields.Number(width), height}, fields.where() + "image size", camera);
  }
}

/// Returns the model that ROS names, or that of OpenCV's calibration.
std::string ModelOf(const DocumentFields& fields) {
  const std::string model = fields.Text(kDistortionModel);
  if (!model.empty()) return model;
  const std::string fisheye = fields.Text("fisheye_model");
  return fisheye.empty() || fisheye == "0" || fisheye == "false" ? "plumb_bob" : "fisheye";
}

void SetOpenCvDistortion(const DocumentFields& fields, CameraParameters& camera) {
  const std::string model = ModelOf(fields);
  const std::string key = fields.FirstOf(kCoefficientKeys);
  const std::vector<double> values = fields.Numbers(key, 0, 14);
  const std::string field = fields.where() + key;
  if (model == "plumb_bob" || model == "rational_polynomial") {
    const char* const name = values.size() > 5 ? "rational_polynomial" : "plumb_bob";
    SetDistortion(kOpenCvCoefficients, values, field, name, camera);
  } else if (model == "equidistant" || model == "fisheye") {
    camera.model = CameraModel::kKb4;
    SetDistortion(kFisheyeCoefficients, values, field, model, camera);
  } else {
    ThrowUnknownModel(fields.where() + kDistortionModel, model,
                      "plumb_bob, rational_polynomial and equidistant");
  }
}

}  // namespace

std::vector<std::string> OpenCvCameras(const CalibrationContent& content) {
  const DocumentFields fields = FieldsOf(content);
  if (!HasMatrix(fields) || fields.Has(kDistortionModel)) return {};
  return {""};
}

std::vector<std::string> RosCameras(const CalibrationContent& content) {
  const DocumentFields fields = FieldsOf(content);
  if (!HasMatrix(fields) || !fields.Has(kDistortionModel)) return {};
  return {""};
}

StatedCamera ReadMatrixCamera(const CalibrationContent& content, const std::string& /*name*/) {
  const DocumentFields fields = FieldsOf(content);
  StatedCamera stated{{}, {}, content.where()};
  const std::string key = fields.FirstOf(kMatrix);
  SetCameraMatrix(fields.Numbers(key, 9, 9), fields.where() + key, stated.parameters);
  SetSizeOf(fields, stated.parameters);
  SetOpenCvDistortion(fields, stated.parameters);
  return stated;
}

}  // namespace corvo
