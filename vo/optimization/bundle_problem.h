#pragma once

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "vo/optimization/bundle.h"

namespace corvo {

/// Gives the poses their manifold and holds what fixes the gauge: the fixed views, or else the
/// oldest one and the farthest one's distance from it.
void FixGauge(Bundle& bundle, ceres::Problem& problem);

/// Schur elimination of the points by dense algebra: the same bits every time.
ceres::Solver::Options SolverOptions(int max_iterations);

}  // namespace corvo
