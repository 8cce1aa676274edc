// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// A camera, x right, y down, z forward; integer pixel coordinates are pixel centers. The model
/// takes (x/z, y/z) to the distorted point (x_d, y_d):
///
///     u = fx x_d + cx
///     v = fy y_d + cy
///
/// A cheap value: new intrinsics are a new Camera.
class Camera {
 public:
  using Jacobian = Eigen::Matrix<double, 2, 3>;

  /// Throws corvo::Error naming the first parameter out of range.
  explicit Camera(const CameraParameters& parameters);

  /// The same without an exception: none where a parameter is out of range.
  static std::optional<Camera> Make(const CameraParameters& parameters);

  /// Pixel of a point. None where z <= 0 or outside max_radius(). The pixel may lie outside the
  /// image. `jacobian`, if given, is d pixel / d point.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_camera,
                                         Jacobian* jacobian = nullptr) const;

  /// (x/z, y/z) of the ray through a pixel, to rounding; none where no ray inside max_radius()
  /// meets the pixel.
  std::optional<Eigen::Vector2d> Undistort(const Eigen::Vector2d& pixel) const;

  /// The pixel lies in the image: in [-0.5, width - 0.5) x [-0.5, height - 0.5).
  bool Contains(const Eigen::Vector2d& pixel) const;

  const CameraParameters& parameters() const { return parameters_; }
  int width() const { return parameters_.width; }    ///< px
  int height() const { return parameters_.height; }  ///< px
  double fx() const { return parameters_.fx; }       ///< px
  double fy() const { return parameters_.fy; }       ///< px
  double cx() const { return parameters_.cx; }       ///< px
  double cy() const { return parameters_.cy; }       ///< px
  /// Mean focal length, px: turns small angles near the axis into pixels.
  double focal() const { return 0.5 * (fx() + fy()); }

  /// Pixels for a unit of (x/z, y/z) around a ray inside max_radius(): pixel noise over this is the
  /// ray's, root mean square of both axes. It falls towards the border of a wide lens. Distortion
  /// of the pinhole model is small and neglected: there it is focal().
  double FocalAt(const Eigen::Vector2d& ray) const;

  /// The model holds for |(x/z, y/z)| below this: up to here the distorted radius grows with the
  /// undistorted one (beyond it rays would meet the image twice), and kb4 and fov end at
  /// kMaxAngle (vo/camera/projection.h) from the axis. Infinity for a pinhole that has no such end.
  double max_radius() const { return max_radius_; }

  /// The camera of the same images resized to `width` x `height`: with s = width / width(),
  /// fx s and (cx + 0.5) s - 0.5, so that the image's corners stay its corners.
  Camera Resized(int width, int height) const;

  bool operator==(const Camera&) const = default;

 private:
  CameraParameters parameters_;
  double max_radius_;
};

}  // namespace corvo
