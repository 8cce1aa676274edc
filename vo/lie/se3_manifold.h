// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/manifold.h>

namespace corvo {

/// SE3 for Ceres: ambient [qx qy qz qw tx ty tz], tangent [υ ω], perturbation on the right:
///
///     Plus(x, δ) = x * Exp(δ)              Minus(y, x) = Log(x⁻¹ y)
///
/// Both Jacobians are those of Plus and Minus at zero, so a cost returns its derivatives with
/// respect to the ambient parameters, or uses its own tangent and chains with PlusJacobian. The
/// quaternion may deviate from unit norm by rounding; it is normalized wherever it is read.
class SE3Manifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace corvo
