// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace corvo {

/// The projection model of a camera. The equations are in the headers of the projections.
enum class CameraModel {
  kPinhole,  ///< Pinhole with radial-tangential distortion: vo/camera/projection_radtan.h.
  kKb4,  ///< Kannala-Brandt fisheye with four coefficients: vo/camera/projection_kannala_brandt.h.
  kFov,  ///< Field-of-view model, also called ATAN: vo/camera/projection_fov.h.
};

/// Returns "pinhole-radtan", "kb4" or "fov".
std::string_view ToString(CameraModel model);

/// Returns the model of a name; "pinhole" is short for "pinhole-radtan". Throws corvo::Error for
/// any other name.
CameraModel ParseCameraModel(std::string_view name);

/// Returns whether a model has a parameter of this name, as named by VisitAll.
bool HasParameter(CameraModel model, std::string_view name);

/// The parameters of a Camera. `VisitAll` names each of them once, with its range and meaning;
/// validation and the camera files are derived from it.
struct CameraParameters {
  CameraModel model = CameraModel::kPinhole;
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, omega = 0;

  /// Throws corvo::Error naming the first field that is out of range, or that is nonzero although
  /// the model does not have it.
  void Validate() const;
  /// Returns whether Validate does not throw.
  bool IsValid() const;

  /// Calls `field(name, value, min, max, meaning)` for the parameters that the model has, in order;
  /// see orb::ExtractorOptions::Visit.
  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    VisitAll(self, [&](const char* name, auto& value, auto min, auto max, const char* meaning) {
      if (HasParameter(self.model, name)) field(name, value, min, max, meaning);
    });
  }

  /// Like Visit, but for the parameters of every model.
  template <typename Self, typename Visitor>
  static void VisitAll(Self& self, Visitor&& field) {
    field("width", self.width, 1, 100000, "image width, px");
    field("height", self.height, 1, 100000, "image height, px");
    field("fx", self.fx, 1e-3, 1e6, "focal length along x, px");
    field("fy", self.fy, 1e-3, 1e6, "focal length along y, px");
    field("cx", self.cx, -1e6, 1e6, "principal point, px; integers are pixel centers");
    field("cy", self.cy, -1e6, 1e6, "principal point, px; integers are pixel centers");
    field("k1", self.k1, -1e3, 1e3, "radial distortion, factor of r^2; kb4: of theta^2");
    field("k2", self.k2, -1e3, 1e3, "radial distortion, factor of r^4; kb4: of theta^4");
    field("p1", self.p1, -1e3, 1e3, "tangential distortion, as OpenCV's");
    field("p2", self.p2, -1e3, 1e3, "tangential distortion, as OpenCV's");
    field("k3", self.k3, -1e3, 1e3, "radial distortion, factor of r^6; kb4: of theta^6");
    field("k4", self.k4, -1e3, 1e3, "kb4: factor of theta^8");
    field("omega", self.omega, 0.0, 3.0, "fov: the model's angle, radians; 0: no distortion");
  }

  bool operator==(const CameraParameters&) const = default;
};

}  // namespace corvo
