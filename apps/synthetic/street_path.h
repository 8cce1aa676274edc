// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

namespace corvo::synthetic {

/// The center line of a road in the plane: straights, gentle bends to either side, and right angles
/// of 12 m radius, alternately left and right, so that the road never crosses itself. The curvature
/// is continuous.
class StreetPath {
 public:
  struct Place {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
    double heading = 0;                                  ///< rad, from x towards y.
    double curvature = 0;                                ///< 1/m, positive to the left.

    /// Returns the point `left` meters to the left of the center line.
    Eigen::Vector2d Inflated(double left) const;
  };

  /// Starts at the origin along x.
  explicit StreetPath(double length);

  double length() const;
  /// Returns the place after `distance` meters, clamped to the road.
  Place At(double distance) const;

  /// Returns the distance from a point to the nearest place of the road between two distances along
  /// it, m.
  double Clearance(const Eigen::Vector2d& point, double from, double to) const;

 private:
  std::vector<Place> places_;  ///< Places every kStep meters.
};

}  // namespace corvo::synthetic
