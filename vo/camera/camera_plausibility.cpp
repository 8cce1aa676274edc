// SPDX-License-Identifier: MIT
#include "vo/camera/camera_plausibility.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/camera/centered_pinhole.h"

namespace corvo {
namespace {

constexpr double kMinFocalPx = 5;
constexpr double kMaxCenterOffset = 0.2;  // As a share of the image width.
constexpr double kMinFovDeg = 5;
constexpr double kMaxPinholeFovDeg = 150;
constexpr double kMaxFisheyeFovDeg = 360;

/// The parameters along one axis of the image.
struct Axis {
  const char* focal_name;
  const char* center_name;
  const char* direction;
  const char* extent;
  double focal, center;
  int size;

  double middle() const { return 0.5 * (size - 1); }
};

std::array<Axis, 2> AxesOf(const CameraParameters& camera) {
  return {{{"fx", "cx", "horizontal", "width", camera.fx, camera.cx, camera.width},
           {"fy", "cy", "vertical", "height", camera.fy, camera.cy, camera.height}}};
}

/// Returns whether the principal point would be in the center of images of `factor` times the size.
bool FitsSize(const CameraParameters& camera, double factor) {
  constexpr double kTolerance = 0.15;
  for (const Axis& axis : AxesOf(camera)) {
    const double expected = 0.5 * factor * axis.size;
    if (std::abs(axis.center - expected) > kTolerance * expected) return false;
  }
  return true;
}

/// Returns the likely reason for a principal point that is not near the center.
std::string CenterHint(const CameraParameters& camera) {
  if (FitsSize(camera, 2)) return ": looks like a calibration of images of twice the size";
  if (FitsSize(camera, 0.5)) return ": looks like a calibration of images of half the size";
  return "";
}

void CheckFocal(const Axis& axis) {
  if (axis.focal >= kMinFocalPx) return;
  throw Error(
      fmt::format("camera.{} is {}; allowed is {} px or more: looks like a focal length in mm, or "
                  "as a share of "
                  "the image {}, which is {} px",
                  axis.focal_name, axis.focal, kMinFocalPx, axis.extent, axis.size));
}

void CheckCenter(const Axis& axis, const std::string& hint) {
  if (axis.center > 0 && axis.center < axis.size) return;
  throw Error(
      fmt::format("camera.{} is {}; allowed is more than 0 and less than the image {}, {} px{}",
                  axis.center_name, axis.center, axis.extent, axis.size, hint));
}

/// Returns the field of view along an axis, or std::nullopt if the model's is not known without its
/// distortion.
std::optional<double> FovOf(CameraModel model, const Axis& axis) {
  if (model == CameraModel::kPinhole) return FovOfFocal(axis.focal, axis.size);
  if (model == CameraModel::kKb4) return axis.size / axis.focal * 180 / std::numbers::pi;
  return std::nullopt;
}

void AddUnusualFov(CameraModel model, const Axis& axis, std::vector<std::string>& unusual) {
  const double max_deg = model == CameraModel::kPinhole ? kMaxPinholeFovDeg : kMaxFisheyeFovDeg;
  const std::optional<double> fov_deg = FovOf(model, axis);
  if (!fov_deg || (*fov_deg >= kMinFovDeg && *fov_deg <= max_deg)) return;
  const char* const hint =
      *fov_deg > max_deg ? "is it in mm, or of smaller images?" : "is it of larger images?";
  unusual.push_back(fmt::format(
      "camera.{} is {} px, a {} field of view of {:.3g} degrees; usual is {} to {} degrees: {}",
      axis.focal_name, axis.focal, axis.direction, *fov_deg, kMinFovDeg, max_deg, hint));
}

void AddUnusualCenter(const CameraParameters& camera, const Axis& axis,
                      std::vector<std::string>& unusual) {
  const double max_offset = kMaxCenterOffset * camera.width;
  if (std::abs(axis.center - axis.middle()) <= max_offset) return;
  unusual.push_back(fmt::format(
      "camera.{} is {} px, far from the center of the image; usual is {:.1f} to {:.1f} px{}",
      axis.center_name, axis.center, axis.middle() - max_offset, axis.middle() + max_offset,
      CenterHint(camera)));
}

}  // namespace

void CheckPlausible(const CameraParameters& camera) {
  for (const Axis& axis : AxesOf(camera)) CheckFocal(axis);
  for (const Axis& axis : AxesOf(camera)) CheckCenter(axis, CenterHint(camera));
}

std::vector<std::string> UnusualValues(const CameraParameters& camera) {
  std::vector<std::string> unusual;
  for (const Axis& axis : AxesOf(camera)) AddUnusualFov(camera.model, axis, unusual);
  for (const Axis& axis : AxesOf(camera)) AddUnusualCenter(camera, axis, unusual);
  return unusual;
}

}  // namespace corvo
