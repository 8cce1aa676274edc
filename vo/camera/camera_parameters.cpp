// SPDX-License-Identifier: MIT
#include "vo/camera/camera_parameters.h"

#include <algorithm>
#include <array>
#include <span>
#include <sstream>
#include <string>

#include "orb/error.h"

namespace corvo {
namespace {

constexpr std::array<CameraModel, 3> kModels = {CameraModel::kPinhole, CameraModel::kKb4,
                                                CameraModel::kFov};

/// Returns the names of the distortion parameters.
std::span<const std::string_view> DistortionFieldNames(CameraModel model) {
  static constexpr std::array<std::string_view, 5> kPinhole = {"k1", "k2", "p1", "p2", "k3"};
  static constexpr std::array<std::string_view, 4> kKb4 = {"k1", "k2", "k3", "k4"};
  static constexpr std::array<std::string_view, 1> kFov = {"omega"};
  switch (model) {
    case CameraModel::kPinhole:
      return kPinhole;
    case CameraModel::kKb4:
      return kKb4;
    case CameraModel::kFov:
      return kFov;
  }
  return {};
}

bool Distorts(CameraModel model, std::string_view name) {
  const auto names = DistortionFieldNames(model);
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string_view ToString(CameraModel model) {
  switch (model) {
    case CameraModel::kPinhole:
      return "pinhole-radtan";
    case CameraModel::kKb4:
      return "kb4";
    case CameraModel::kFov:
      return "fov";
  }
  return "";
}

CameraModel ParseCameraModel(std::string_view name) {
  if (name == "pinhole") return CameraModel::kPinhole;
  for (const CameraModel model : kModels) {
    if (name == ToString(model)) return model;
  }
  throw Error("camera model is \"" + std::string(name) +
              "\"; allowed is pinhole-radtan, kb4 or fov");
}

bool HasParameter(CameraModel model, std::string_view name) {
  if (Distorts(model, name)) return true;
  return std::none_of(kModels.begin(), kModels.end(),
                      [&](CameraModel other) { return Distorts(other, name); });
}

void CameraParameters::Validate() const {
  VisitAll(*this, [this](const char* name, const auto& value, auto min, auto max, const char*) {
    const std::string field = std::string("camera.") + name;
    CheckRange(field, value, min, max);
    if (value == 0 || HasParameter(model, name)) return;
    std::ostringstream message;
    message << field << " is " << value << "; the model " << ToString(model)
            << " has no such parameter: leave it out";
    throw Error(message.str());
  });
}

bool CameraParameters::IsValid() const {
  bool is_valid = true;
  VisitAll(*this, [&](const char* name, const auto& value, auto min, auto max, const char*) {
    is_valid &= value >= min && value <= max && (value == 0 || HasParameter(model, name));
  });
  return is_valid;
}

}  // namespace corvo
