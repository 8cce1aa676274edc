// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "vo/lie/se3.h"

namespace corvo::test {

/// A seeded generator for tests, which gives the same numbers with every compiler and standard
/// library (SplitMix64). Several draws in one expression must be in braces: the order of evaluation
/// of a call's arguments is up to the compiler, that of braces is defined.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// Returns a uniform number in [min, max).
  double Uniform(double min = 0, double max = 1) {
    return min + (max - min) * 0x1p-53 * static_cast<double>(Bits() >> 11);
  }

  /// Returns a uniform integer in [min, max].
  int UniformInt(int min, int max) {
    const std::uint64_t count = static_cast<std::uint64_t>(std::int64_t{max} - min + 1);
    return static_cast<int>(min + static_cast<std::int64_t>(Bits() % count));
  }

  /// Returns a normal number with mean 0 (Box-Muller).
  double Gaussian(double sigma = 1) {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
    return sigma * radius * std::cos(2 * 3.14159265358979323846 * Uniform());
  }

  /// Returns a vector of independent entries in [-bound, bound).
  template <int Size>
  Eigen::Matrix<double, Size, 1> Vector(double bound = 1) {
    Eigen::Matrix<double, Size, 1> vector;
    for (double& entry : vector) entry = Uniform(-bound, bound);
    return vector;
  }

  Eigen::Vector3d Direction() {
    Eigen::Vector3d vector;
    do vector = Eigen::Vector3d{Gaussian(), Gaussian(), Gaussian()};
    while (vector.norm() < 1e-6);
    return vector.normalized();
  }

  /// Returns a rotation about a uniform axis by an angle uniform in [0, max_angle) rad.
  SO3 Rotation(double max_angle = 3.14159265358979323846) {
    const double angle = Uniform(0, max_angle);
    return SO3::Exp(angle * Direction());
  }

  SE3 Pose(double max_angle = 3.14159265358979323846, double max_distance = 1) {
    const SO3 rotation = Rotation(max_angle);
    const double distance = Uniform(0, max_distance);
    return SE3(rotation, distance * Direction());
  }

 private:
  std::uint64_t state_;
};

}  // namespace corvo::test
