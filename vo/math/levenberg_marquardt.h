// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace corvo {

/// The normal equations of a weighted least-squares cost in N parameters at one state.
template <int N>
struct NormalEquations {
  Eigen::Matrix<double, N, N> hessian = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> gradient = Eigen::Matrix<double, N, 1>::Zero();
  double cost = 0;
};

template <typename State>
struct Minimum {
  State state;
  double cost;
};

/// Minimizes a cost with few parameters (Marquardt 1963). Returns the state of least cost reached
/// from `state` within `max_iterations`; its cost is never higher than that of `state`.
/// `build(state)` returns the NormalEquations<N> at a state, `plus(state, step)` the state after a
/// step of N numbers.
template <int N, typename State, typename Build, typename Plus>
Minimum<State> MinimizeLevenbergMarquardt(State state, Build&& build, Plus&& plus,
                                          int max_iterations) {
  constexpr double kConverged = 1e-6;  // Decrease relative to the cost.
  using Vector = Eigen::Matrix<double, N, 1>;
  double damping = 1e-4;
  NormalEquations<N> now = build(state);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Eigen::Matrix<double, N, N> damped = now.hessian;
    damped.diagonal() += damping * now.hessian.diagonal() + Vector::Constant(1e-9);
    const Vector step = -damped.ldlt().solve(now.gradient);
    if (!step.allFinite()) break;
    const State candidate = plus(state, step);
    const NormalEquations<N> next = build(candidate);
    if (next.cost < now.cost) {
      const bool has_converged = now.cost - next.cost < kConverged * now.cost;
      state = candidate;
      now = next;
      damping *= 0.1;
      if (has_converged) break;
    } else {
      damping *= 10;
      if (damping > 1e6) break;
    }
  }
  return {state, now.cost};
}

}  // namespace corvo
