// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/stated_camera.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

/// Sets the distortion parameter `name`. Returns false if the camera's model does not have it.
bool SetParameter(std::string_view name, double value, CameraParameters& camera) {
  bool is_set = false;
  CameraParameters::Visit(camera, [&](const char* own, auto& parameter, auto, auto, const char*) {
    if (name != own) return;
    parameter = static_cast<std::remove_reference_t<decltype(parameter)>>(value);
    is_set = true;
  });
  return is_set;
}

int ToPixels(const std::string& field, double value) {
  CheckRange(field, value, 1.0, 1e5);
  if (value == std::floor(value)) return static_cast<int>(value);
  throw Error(fmt::format("{} is {}; allowed is a whole number", field, value));
}

}  // namespace

void StatedCamera::Validate() const {
  CameraParameters checked = parameters;
  if (!has_size()) checked.width = checked.height = 1;
  try {
    checked.Validate();
  } catch (const Error& error) {
    throw Error(where + error.what());
  }
}

CameraFile StatedCamera::ForImages(int width, int height) const {
  CameraParameters camera = parameters;
  if (!has_size()) {
    camera.width = width;
    camera.height = height;
  }
  return {Camera(camera), frame_rate_hz, source, sigma};
}

void SetDistortion(std::span<const char* const> names, const std::vector<double>& values,
                   const std::string& field, std::string_view tool_model,
                   CameraParameters& camera) {
  if (values.size() > names.size()) {
    throw Error(fmt::format("{}: {} distortion coefficients; the model {} has at most {}", field,
                            values.size(), tool_model, names.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (SetParameter(names[i], values[i], camera) || values[i] == 0) continue;
    throw Error(
        fmt::format("{}: {} is {}; corvo has no model {}, and its model {} has no {}: it is read "
                    "only if that is 0",
                    field, names[i], values[i], tool_model, ToString(camera.model), names[i]));
  }
  const bool is_undistorted_fov = camera.model == CameraModel::kFov && camera.omega == 0;
  if (is_undistorted_fov) camera.model = CameraModel::kPinhole;
}

void SetCameraMatrix(const std::vector<double>& matrix, const std::string& field,
                     CameraParameters& camera) {
  const std::size_t stride = matrix.size() / 3;
  if (matrix[1] != 0) {
    throw Error(fmt::format("{}: the skew, in row 1, column 2, is {}; corvo's cameras have none",
                            field, matrix[1]));
  }
  SetIntrinsics({matrix[0], matrix[stride + 1], matrix[2], matrix[stride + 2]}, camera);
}

void SetIntrinsics(const std::vector<double>& values, CameraParameters& camera) {
  camera.fx = values[0];
  camera.fy = values[1];
  camera.cx = values[2];
  camera.cy = values[3];
}

void SetSize(const std::vector<double>& values, const std::string& field,
             CameraParameters& camera) {
  camera.width = ToPixels(field + ": width", values[0]);
  camera.height = ToPixels(field + ": height", values[1]);
}

void ThrowUnknownModel(const std::string& field, std::string_view value, std::string_view known) {
  throw Error(fmt::format("{} is '{}'; only {} can be read: corvo has no other camera models",
                          field, value, known));
}

}  // namespace corvo
