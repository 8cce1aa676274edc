// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// A camera with the axes x right, y down, z forward; integer pixel coordinates are pixel centers.
/// The model maps (x/z, y/z) to the distorted point (x_d, y_d):
///
///     u = fx x_d + cx
///     v = fy y_d + cy
///
/// A cheap value type: new intrinsics require a new Camera.
class Camera {
 public:
  using Jacobian = Eigen::Matrix<double, 2, 3>;

  /// Throws corvo::Error naming the first parameter out of range.
  explicit Camera(const CameraParameters& parameters);

  /// Like the constructor, but returns std::nullopt if a parameter is out of range.
  static std::optional<Camera> Make(const CameraParameters& parameters);

  /// Returns the pixel of a point, which may lie outside the image, or std::nullopt if z <= 0 or
  /// the point is outside max_radius(), or if a result would not be finite. `jacobian`, if given,
  /// is set to d pixel / d point.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_camera,
                                         Jacobian* jacobian = nullptr) const;

  /// Returns (x/z, y/z) of the ray through a pixel, exact to rounding, or std::nullopt if no ray
  /// inside max_radius() projects to the pixel.
  std::optional<Eigen::Vector2d> Undistort(const Eigen::Vector2d& pixel) const;

  /// Returns whether the pixel lies in the image: in [-0.5, width - 0.5) x [-0.5, height - 0.5).
  bool Contains(const Eigen::Vector2d& pixel) const;

  const CameraParameters& parameters() const { return parameters_; }
  int width() const { return parameters_.width; }    ///< px
  int height() const { return parameters_.height; }  ///< px
  double fx() const { return parameters_.fx; }       ///< px
  double fy() const { return parameters_.fy; }       ///< px
  double cx() const { return parameters_.cx; }       ///< px
  double cy() const { return parameters_.cy; }       ///< px
  /// Returns the mean focal length, px, which converts small angles near the axis to pixels.
  double focal() const { return 0.5 * (fx() + fy()); }

  /// Returns the focal length around a ray inside max_radius(), px per unit of (x/z, y/z): pixel
  /// noise divided by it is the noise of the ray, root mean square of both axes. It decreases
  /// toward the border of a wide lens, where it is at least 1e-6 of the smaller of fx and fy. For
  /// the pinhole model, distortion is small and neglected, and the result is focal(). Throws
  /// corvo::Error if the ray is not finite.
  double FocalAt(const Eigen::Vector2d& ray) const;

  /// Returns the limit on |(x/z, y/z)| below which the model holds. Up to this limit the distorted
  /// radius grows with the undistorted one (beyond it, rays would meet the image twice); kb4 and
  /// fov end at kMaxAngle (vo/camera/projection.h) from the axis. Infinity for a pinhole without a
  /// limit.
  double max_radius() const { return max_radius_; }

  /// Returns the camera of the same images resized to `width` x `height`: with s = width / width(),
  /// fx s and (cx + 0.5) s - 0.5, so that the corners of the image remain its corners.
  Camera Resized(int width, int height) const;

  bool operator==(const Camera&) const = default;

 private:
  CameraParameters parameters_;
  double max_radius_;
};

}  // namespace corvo
