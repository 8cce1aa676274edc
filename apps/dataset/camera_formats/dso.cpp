// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "orb/error.h"

namespace corvo {
namespace {

/// A model of DSO: the word before its numbers, and its distortion after fx fy cx cy.
struct DsoModel {
  std::string_view name;
  CameraModel model;
  std::span<const char* const> coefficients;

  std::size_t num_values() const { return 4 + coefficients.size(); }
};

constexpr std::array<DsoModel, 4> kDsoModels = {{
    {"Pinhole", CameraModel::kFov, kFovCoefficients},  // omega is 0.
    {"FOV", CameraModel::kFov, kFovCoefficients},
    {"RadTan", CameraModel::kPinhole, std::span<const char* const>(kOpenCvCoefficients, 4)},
    {"EquiDistant", CameraModel::kKb4, kFisheyeCoefficients},
}};

/// Returns the numbers among `fields`. Throws corvo::Error if one is not a number.
std::vector<double> ToNumbers(std::span<const std::string> fields, const std::string& where) {
  std::vector<double> numbers;
  for (const std::string& field : fields) numbers.push_back(ParseNumber(field, where));
  return numbers;
}

bool AreNumbers(std::span<const std::string> fields) {
  return std::ranges::all_of(fields, IsNumber);
}

/// Returns the model of a first line: named, or else FOV with 5 or RadTan with 8 numbers. Returns
/// nullptr for any other line.
const DsoModel* FindModel(const std::vector<std::string>& fields) {
  if (fields.empty()) return nullptr;
  const auto named = std::ranges::find(kDsoModels, fields[0], &DsoModel::name);
  if (named != kDsoModels.end()) return &*named;
  if (!AreNumbers(fields)) return nullptr;
  const auto unnamed = std::ranges::find(kDsoModels.begin() + 1, kDsoModels.end(), fields.size(),
                                         &DsoModel::num_values);
  return unnamed == kDsoModels.end() ? nullptr : &*unnamed;
}

/// Scales shares of the image's size, with the origin at its corner, to pixels. If cx and cy are
/// above 1, all four are in pixels.
void ToPixels(const std::string& where, CameraParameters& camera) {
  if (camera.cx > 1 && camera.cy > 1) return;
  if (camera.cx > 1 || camera.cy > 1) {
    throw Error(
        fmt::format("{}cx is {} and cy {}: both must be fractions of the image's width and "
                    "height, or both pixels",
                    where, camera.cx, camera.cy));
  }
  camera.fx *= camera.width;
  camera.fy *= camera.height;
  camera.cx = camera.cx * camera.width - 0.5;
  camera.cy = camera.cy * camera.height - 0.5;
}

/// Reads the second line, "width height". A file in pixels may end before it.
void ReadSize(const CalibrationContent& content, CameraParameters& camera) {
  if (content.lines().size() < 2) {
    if (camera.cx > 1 && camera.cy > 1) return;
    throw Error(fmt::format("{}has no second line, with the size of the images", content.where()));
  }
  const TextLine& line = content.lines()[1];
  const std::string where = LinePrefix(content.file(), line);
  const std::vector<std::string> fields = CalibrationFields(line);
  if (fields.size() != 2)
    throw Error(fmt::format("{}'{}' is not 'width height'", where, line.text));
  SetSize(ToNumbers(fields, where), where + "image size", camera);
}

}  // namespace

std::vector<std::string> DsoCameras(const CalibrationContent& content) {
  const std::vector<TextLine>& lines = content.lines();
  if (lines.empty()) return {};
  const std::vector<std::string> fields = CalibrationFields(lines[0]);
  const DsoModel* const model = FindModel(fields);
  if (!model) return {};
  const bool is_one_line = lines.size() == 1 && fields.size() == 8 && AreNumbers(fields);
  if (is_one_line) return {};
  return {""};
}

StatedCamera ReadDsoCamera(const CalibrationContent& content, const std::string& /*name*/) {
  const TextLine& line = content.lines()[0];
  StatedCamera stated{{}, {}, LinePrefix(content.file(), line)};
  std::vector<std::string> fields = CalibrationFields(line);
  const DsoModel& model = *FindModel(fields);
  if (fields[0] == model.name) fields.erase(fields.begin());
  if (fields.size() != model.num_values()) {
    throw Error(fmt::format("{}{} numbers; the model {} has {}", stated.where, fields.size(),
                            model.name, model.num_values()));
  }
  std::vector<double> values = ToNumbers(fields, stated.where);
  CameraParameters& camera = stated.parameters;
  camera.model = model.model;
  SetIntrinsics(values, camera);
  values.erase(values.begin(), values.begin() + 4);
  if (model.name == "Pinhole" && values[0] != 0) {
    throw Error(fmt::format("{}the number after cy is {}; it is 0 in the model Pinhole",
                            stated.where, values[0]));
  }
  SetDistortion(model.coefficients, values, stated.where + line.text, model.name, camera);
  ReadSize(content, camera);
  ToPixels(stated.where, camera);
  return stated;
}

}  // namespace corvo
