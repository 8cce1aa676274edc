// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace corvo {

/// Of a weighted least-squares cost in N parameters, at one state.
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

/// Levenberg-Marquardt for few parameters (Marquardt 1963): the state of least cost reached from
/// `state` within `max_iterations`, never one of higher cost. `build(state)` gives its
/// NormalEquations<N>, `plus(state, step)` the state a step of N numbers away.
template <int N, typename State, typename Build, typename Plus>
Minimum<State> MinimizeLevenbergMarquardt(State state, Build&& build, Plus&& plus,
                                          int max_iterations) {
  constexpr double kConverged = 1e-6;  // Share of the cost.
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
