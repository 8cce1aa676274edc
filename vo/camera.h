#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

namespace corvo {

/// Pinhole camera with radial-tangential distortion (Brown-Conrady, OpenCV's convention), x right,
/// y down, z forward; integer pixel coordinates are pixel centres. With a = x/z, b = y/z,
/// r² = a² + b², c = 1 + k1 r² + k2 r⁴ + k3 r⁶:
///
///     u = fx (a c + 2 p1 a b + p2 (r² + 2 a²)) + cx
///     v = fy (b c + p1 (r² + 2 b²) + 2 p2 a b) + cy
struct Camera {
  int width = 0;   ///< px
  int height = 0;  ///< px
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< px
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

  using Jacobian = Eigen::Matrix<double, 2, 3>;

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;

  /// Pixel of a point. None where z <= 0 or the distortion is not one-to-one any more (outside
  /// max_radius()). The pixel may lie outside the picture. `jacobian`, if given, is d pixel / d point.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_camera,
                                         Jacobian* jacobian = nullptr) const;

  /// (x/z, y/z) of the ray through a pixel; none where no ray inside max_radius() meets the pixel.
  std::optional<Eigen::Vector2d> Undistort(const Eigen::Vector2d& pixel) const;

  bool Contains(const Eigen::Vector2d& pixel) const;

  /// Mean focal length, px: turns small angles into pixels.
  double focal() const { return 0.5 * (fx + fy); }

  bool operator==(const Camera&) const = default;
};

}  // namespace corvo
