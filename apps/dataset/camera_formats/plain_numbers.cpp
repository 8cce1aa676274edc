// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"
#include "orb/error.h"

namespace corvo {
namespace {

constexpr const char* kModelName = "OpenCV";
constexpr DocumentFields::Keys kWidth = {"image_width", "imageWidth", "width", "w"};
constexpr DocumentFields::Keys kHeight = {"image_height", "imageHeight", "height", "h"};
constexpr DocumentFields::Keys kDistortion = {"distortion_coefficients", "dist_coeffs",
                                              "distCoeffs", "distortion", "D"};

std::vector<double> ReadDistortion(const DocumentFields& fields) {
  const std::string list = fields.FirstOf(kDistortion);
  if (fields.Has(list)) return fields.Numbers(list, 0, 14);
  std::vector<double> values;
  for (const char* key : kOpenCvCoefficients) {
    values.push_back(fields.FindNumber(key).value_or(0));
  }
  return values;
}

}  // namespace

std::vector<std::string> OneLineCameras(const CalibrationContent& content) {
  if (content.lines().size() != 1) return {};
  const std::vector<std::string> fields = CalibrationFields(content.lines()[0]);
  const bool is_camera = fields.size() >= 4 && std::ranges::all_of(fields, IsNumber);
  if (!is_camera) return {};
  return {""};
}

StatedCamera ReadOneLineCamera(const CalibrationContent& content, const std::string& /*name*/) {
  const TextLine& line = content.lines()[0];
  StatedCamera stated{{}, {}, LinePrefix(content.file(), line)};
  std::vector<double> values;
  for (const std::string& field : CalibrationFields(line)) {
    values.push_back(ParseNumber(field, stated.where));
  }
  SetIntrinsics(values, stated.parameters);
  values.erase(values.begin(), values.begin() + 4);
  SetDistortion(kOpenCvCoefficients, values, stated.where + "fx fy cx cy k1 k2 p1 p2", kModelName,
                stated.parameters);
  return stated;
}

std::vector<std::string> PlainCameras(const CalibrationContent& content) {
  const DocumentFields fields(content.root(), content.where());
  const bool is_camera =
      fields.Has("fx") && !fields.Has("model") && (content.is_json() || fields.Has("image_width"));
  if (!is_camera) return {};
  return {""};
}

StatedCamera ReadPlainCamera(const CalibrationContent& content, const std::string& /*name*/) {
  const DocumentFields fields(content.root(), content.where());
  StatedCamera stated{{}, {}, content.where()};
  SetIntrinsics(
      {fields.Number("fx"), fields.Number("fy"), fields.Number("cx"), fields.Number("cy")},
      stated.parameters);
  const std::string width = fields.FirstOf(kWidth);
  if (fields.Has(width)) {
    SetSize({fields.Number(width), fields.Number(fields.FirstOf(kHeight))},
            content.where() + "image size", stated.parameters);
  }
  SetDistortion(kOpenCvCoefficients, ReadDistortion(fields), content.where() + "distortion",
                kModelName, stated.parameters);
  const char* const rate = fields.Has("frame_rate_hz") ? "frame_rate_hz" : "fps";
  stated.frame_rate_hz = StatedFrameRate(fields, rate);
  return stated;
}

}  // namespace corvo
