// SPDX-License-Identifier: MIT
#include "bench/calibration/statistics.h"

#include <Eigen/Cholesky>

namespace corvo::bench {

double NormalizedSquaredError(const Miss& miss) {
  return miss.error.dot(miss.covariance.ldlt().solve(miss.error)) /
         static_cast<double>(miss.error.size());
}

Consistency Judge(const std::vector<Miss>& misses) {
  Consistency consistency;
  consistency.count = static_cast<int>(misses.size());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(misses.front().error.size());
  Eigen::VectorXd num_within = zero, sum_squares = zero, sum_sigmas = zero;
  for (const Miss& miss : misses) {
    const Eigen::VectorXd sigmas = miss.covariance.diagonal().cwiseSqrt();
    num_within.array() += (miss.error.array().abs() <= 3 * sigmas.array()).cast<double>();
    sum_squares += miss.error.cwiseAbs2();
    sum_sigmas += sigmas;
    consistency.mean_normalized_squared_error += NormalizedSquaredError(miss) / consistency.count;
  }
  consistency.share_within_3_sigma = num_within / consistency.count;
  consistency.rms_error = (sum_squares / consistency.count).cwiseSqrt();
  consistency.mean_sigma = sum_sigmas / consistency.count;
  return consistency;
}

}  // namespace corvo::bench
