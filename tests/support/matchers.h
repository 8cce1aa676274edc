// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "orb/error.h"
#include "vo/lie/se3.h"
#include "vo/lie/sim3.h"

// These matchers compare geometry. NaN never matches, and a failure states the exceeded threshold.
namespace corvo::test {

/// Returns whether value <= limit. If not, or for NaN, writes an explanation to `listener`.
inline bool IsWithin(const std::string& what, double value, double limit,
                     ::testing::MatchResultListener* listener) {
  const bool within = value <= limit;
  if (!within) *listener << what << " is " << value << ", more than " << limit << "; ";
  return within;
}

inline double AngleBetweenDeg(const SO3& a, const SO3& b) {
  return (a.Inverse() * b).Angle() * 180 / 3.14159265358979323846;
}

MATCHER_P2(IsDenseNear, expected, tolerance,
           "is within the tolerance of\n" + ::testing::PrintToString(expected)) {
  if (arg.rows() != expected.rows() || arg.cols() != expected.cols()) {
    *result_listener << "its size is " << arg.rows() << " x " << arg.cols();
    return false;
  }
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    const Eigen::Index row = i % expected.rows(), col = i / expected.rows();
    const std::string what =
        "error of entry (" + std::to_string(row) + ", " + std::to_string(col) + ")";
    const double error = std::abs(arg(row, col) - expected(row, col));
    if (!IsWithin(what, error, tolerance, result_listener)) return false;
  }
  return true;
}

/// Matches a matrix or vector whose every entry is within `tolerance` of the expected entry.
template <typename Derived>
auto IsMatrixNear(const Eigen::MatrixBase<Derived>& expected, double tolerance) {
  return IsDenseNear(Eigen::MatrixXd(expected), tolerance);
}

/// Matches an SO3 at an angle of at most `max_deg` from the expected one.
MATCHER_P2(IsRotationNear, expected, max_deg, "is a rotation near the expected one") {
  return IsWithin("angle, deg,", AngleBetweenDeg(expected, arg), max_deg, result_listener);
}

/// Matches an SE3 at most `max_deg` and `max_distance` from the expected one.
MATCHER_P3(IsPoseNear, expected, max_deg, max_distance, "is a pose near the expected one") {
  const double angle = AngleBetweenDeg(expected.rotation(), arg.rotation());
  const double distance = (expected.translation() - arg.translation()).norm();
  const bool rotation_near = IsWithin("angle, deg,", angle, max_deg, result_listener);
  return IsWithin("distance", distance, max_distance, result_listener) && rotation_near;
}

/// Matches a Sim3 near the expected one; `max_log_scale` bounds |log(scale/expected scale)|.
MATCHER_P4(IsSimilarityNear, expected, max_deg, max_distance, max_log_scale,
           "is a similarity near the expected one") {
  const double angle = AngleBetweenDeg(expected.rotation(), arg.rotation());
  const double distance = (expected.translation() - arg.translation()).norm();
  const double log_scale = std::abs(std::log(arg.scale() / expected.scale()));
  const bool rotation_near = IsWithin("angle, deg,", angle, max_deg, result_listener);
  const bool scale_near = IsWithin("log scale error", log_scale, max_log_scale, result_listener);
  return IsWithin("distance", distance, max_distance, result_listener) && rotation_near &&
         scale_near;
}

/// Matches a callable that throws corvo::Error with a message that contains all the texts:
/// EXPECT_THAT([] { ReadOptions("x.yaml"); }, ThrowsError("x.yaml", "no such file")).
template <typename... Texts>
auto ThrowsError(const Texts&... texts) {
  return ::testing::ThrowsMessage<Error>(
      ::testing::AllOf(::testing::HasSubstr(std::string(texts))...));
}

}  // namespace corvo::test
