// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/lie/se3.h"

namespace corvo::test {

/// Returns d f(δ)/dδ at δ = 0 by central differences of fourth order. `f` takes an
/// Eigen::Matrix<double, Cols, 1> and returns something convertible to Eigen::Matrix<double, Rows,
/// 1>; if its domain or range is a manifold, `f` applies Exp and Log itself. The result is correct
/// to about 1e-11 for functions whose derivatives are of magnitude 1; steeper functions need a
/// smaller step.
template <int Rows, int Cols, typename Function>
Eigen::Matrix<double, Rows, Cols> NumericJacobian(const Function& f, double step = 1e-3) {
  using Tangent = Eigen::Matrix<double, Cols, 1>;
  using Value = Eigen::Matrix<double, Rows, 1>;
  Eigen::Matrix<double, Rows, Cols> jacobian;
  for (int i = 0; i < Cols; ++i) {
    const Tangent delta = step * Tangent::Unit(i);
    const Value near = Value(f(delta)) - Value(f(-delta));
    const Value far = Value(f(2 * delta)) - Value(f(-2 * delta));
    jacobian.col(i) = (8 * near - far) / (12 * step);
  }
  return jacobian;
}

/// Returns d f(x + δ)/dδ at δ = 0 for a vector x.
template <int Rows, int Cols, typename Function>
Eigen::Matrix<double, Rows, Cols> NumericJacobianAt(const Eigen::Matrix<double, Cols, 1>& x,
                                                    const Function& f, double step = 1e-3) {
  using Vector = Eigen::Matrix<double, Cols, 1>;
  return NumericJacobian<Rows, Cols>([&](const Vector& delta) { return f(Vector(x + delta)); },
                                     step);
}

/// Returns d f(pose * Exp(δ))/dδ at δ = 0 for corvo's perturbation: on the right, translation
/// first.
template <int Rows, typename Function>
Eigen::Matrix<double, Rows, 6> NumericJacobianAt(const SE3& pose, const Function& f,
                                                 double step = 1e-3) {
  return NumericJacobian<Rows, 6>(
      [&](const SE3::Tangent& delta) { return f(pose * SE3::Exp(delta)); }, step);
}

}  // namespace corvo::test
