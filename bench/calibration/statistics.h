// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

namespace corvo::bench {

/// The error of an estimate and its claimed covariance.
struct Miss {
  Eigen::VectorXd error;
  Eigen::MatrixXd covariance;
};

/// Returns e^T C^-1 e / n (NEES) of an error e of n numbers: 1 on average if the covariance C is
/// consistent.
double NormalizedSquaredError(const Miss& miss);

/// The consistency of the covariances of many misses. Vectors have one entry per parameter.
struct Consistency {
  int count = 0;
  Eigen::VectorXd share_within_3_sigma;  ///< Share of the misses, 0 to 1.
  Eigen::VectorXd rms_error;
  Eigen::VectorXd mean_sigma;
  double mean_normalized_squared_error = 0;
};

/// Computes the consistency of at least one miss. All misses have the same parameters.
Consistency Judge(const std::vector<Miss>& misses);

}  // namespace corvo::bench
