#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/math/huber.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Is told the share done, 0 to 1, after each iteration; returns whether to go on.
using AdjustmentProgress = std::function<bool(double)>;

struct FullAdjustmentOptions {
  int max_iterations = 30;  ///< Of either round.
  /// How often the information of the observations counts, beside the camera's prior.
  double information_factor = 1;
  double huber_sigmas = kHuberSigmas;  ///< Where Huber's loss becomes linear.
};

enum class AdjustmentOutcome {
  kImproved,        ///< The robust cost is lower than before.
  kNoObservations,  ///< There is nothing to adjust.
  kSolverFailed,    ///< No solution, or one that is no camera's; or it was stopped.
  kNotImproved,     ///< The robust cost would be as high as before, or higher.
};

/// What became of a full adjustment. A robust cost is half the sum of Huber's loss of all
/// observations' squared errors, in units of sigma², and of the camera's χ² over the information
/// factor; a observation that does not project counts as one with a squared error of 1e6.
struct FullAdjustment {
  AdjustmentOutcome outcome = AdjustmentOutcome::kNoObservations;
  double initial_cost = 0;
  double final_cost = 0;  ///< Of a solver that did not fail.
  int num_observations = 0;
  int num_inliers = 0;       ///< Of them; below the 95% quantile afterwards.
  double inlier_rms_px = 0;  ///< Of the inliers' errors, both axes together, px.
  CameraParameters camera;   ///< The start, unless the outcome is kImproved.
  /// Of the camera's difference from what is given, see CameraCovariance; empty unless the outcome
  /// is kImproved.
  Eigen::MatrixXd covariance;
};

/// Adjusts the poses and points of bundles that were all seen by one camera, and the camera: it is
/// known as `camera_prior` says, and sought from `start` on. Robust (Huber) and in two rounds: the
/// second goes without the observations that the first leaves more than five sigmas off. The points
/// are eliminated (Schur complement); what is left is solved by dense algebra up to 300 views, by
/// sparse algebra beyond. Each bundle's gauge: its fixed views; with fewer than two of them the
/// oldest view stays where it is, and the farthest keeps its distance from it. Afterwards
/// observations over the 95% quantile are marked as outliers. Unless the outcome is kImproved the
/// bundles are as they were. Deterministic. Throws corvo::Error on a prior that is not valid, and
/// on a start that is no camera.
FullAdjustment AdjustFully(const CameraPrior& camera_prior, const CameraParameters& start,
                           const FullAdjustmentOptions& options, std::vector<Bundle>& bundles,
                           const AdjustmentProgress& progress = {});

/// What is left of a bundle when of every view only about so many points are kept, see
/// SelectPoints, so that an adjustment's size grows with the views alone; points seen by fewer than
/// two views go.
Bundle ThinPoints(const Bundle& bundle, int max_points);

}  // namespace corvo
