// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vo/camera/camera_parameters.h"
#include "vo/camera/camera_prior.h"
#include "vo/io/config.h"

namespace corvo {

/// A camera as a calibration file states it.
struct StatedCamera {
  CameraParameters parameters;  ///< `width` and `height` are 0 if the file does not state them.
  std::optional<double> frame_rate_hz = {};
  std::string where = {};   ///< The start of messages about its values: "<file>: ".
  std::string source = {};  ///< Origin of the numbers, as in CameraFile.
  std::optional<std::vector<FreeParameter>> sigma = {};  ///< As in CameraFile.

  bool has_size() const { return parameters.width != 0; }

  /// Throws corvo::Error if a parameter is out of range. A size that is not stated is not checked.
  void Validate() const;

  /// Returns the camera of images of this size, which is used only if the file does not state one:
  /// whether images have the stated size is checked where they are read.
  CameraFile ForImages(int width, int height) const;
};

// Functions that set parameters of a camera from a tool's numbers. `field` precedes the names of
// values in messages: "<file>: distortion_coefficients". All throw corvo::Error if a value is out
// of its range or cannot be held by corvo's cameras.

/// The order of OpenCV's distortion coefficients.
inline constexpr const char* kOpenCvCoefficients[] = {"k1", "k2", "p1", "p2", "k3", "k4",   "k5",
                                                      "k6", "s1", "s2", "s3", "s4", "taux", "tauy"};
/// That of OpenCV's fisheye module, Kalibr's equidistant distortion and others.
inline constexpr const char* kFisheyeCoefficients[] = {"k1", "k2", "k3", "k4"};
inline constexpr const char* kFovCoefficients[] = {"omega"};

/// Sets the distortion of a camera whose model is set. `values` are the coefficients of `names`, or
/// the first of them; the others are 0. Throws if one is not 0 that the camera's model does not
/// have; `tool_model` is the name of the model in the file, for the message.
void SetDistortion(std::span<const char* const> names, const std::vector<double>& values,
                   const std::string& field, std::string_view tool_model, CameraParameters& camera);

/// Sets the focal length and principal point to those of a matrix of 3 rows, row-major: 9 numbers,
/// or 12 of a projection matrix. Throws if it has skew.
void SetCameraMatrix(const std::vector<double>& matrix, const std::string& field,
                     CameraParameters& camera);

/// Sets the focal length and principal point to fx, fy, cx, cy.
void SetIntrinsics(const std::vector<double>& values, CameraParameters& camera);

/// Sets the size to `values`, width and height.
void SetSize(const std::vector<double>& values, const std::string& field, CameraParameters& camera);

/// Throws corvo::Error: the camera model `value` of `field` is not among those that can be read.
[[noreturn]] void ThrowUnknownModel(const std::string& field, std::string_view value,
                                    std::string_view known);

}  // namespace corvo
