// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

namespace corvo::bench {

/// By how much an estimate missed the truth, and the covariance that it claimed.
struct Miss {
  Eigen::VectorXd error;
  Eigen::MatrixXd covariance;
};

/// e^T C^-1 e / n of an error of n numbers: 1 on average if the covariance is consistent.
double NormalizedSquaredError(const Miss& miss);

/// How consistent the covariances of many misses are. Vectors: one entry a parameter.
struct Consistency {
  int count = 0;
  Eigen::VectorXd share_within_3_sigma;  ///< Of the misses, 0 to 1.
  Eigen::VectorXd rms_error;
  Eigen::VectorXd mean_sigma;
  double mean_normalized_squared_error = 0;
};

/// Of at least one miss, all of the same parameters.
Consistency Judge(const std::vector<Miss>& misses);

}  // namespace corvo::bench
