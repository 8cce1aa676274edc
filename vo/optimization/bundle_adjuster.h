// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/adjustment_status.h"
#include "vo/core/options.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Is told the share done, 0 to 1, after each iteration; returns whether to go on.
using AdjustmentProgress = std::function<bool(double)>;

/// How bundles are adjusted. Windows, estimates of the camera and global adjustments differ in
/// these, and in what is free, alone.
struct AdjustmentOptions {
  int num_rounds = 1;       ///< Before each but the first, gross errors are set aside.
  int max_iterations = 30;  ///< Of each round.
  double huber_sigmas = 1;  ///< Residual at which Huber's loss becomes linear.
  /// Observations with a larger residual are set aside before the first round; standard deviations.
  double max_initial_error_sigmas = std::numeric_limits<double>::infinity();
  /// The same, before each later round.
  double max_error_sigmas = 5;
  /// How often the information of the observations counts beside the camera's prior.
  double information_factor = 1;
  /// Points of each free view that are adjusted jointly with it, longest tracks first; 0: all. The
  /// others are adjusted afterwards, each alone.
  int points_per_view = 0;
  int point_iterations = 5;   ///< Of a point that is adjusted alone.
  int max_dense_views = 300;  ///< With more views, sparse linear algebra is used.
};

/// The adjustment of a window by the user's options.
AdjustmentOptions WindowAdjustment(const BundleAdjusterOptions& options);
/// The estimate of the camera from the newest keyframes, of which there are so many.
AdjustmentOptions CalibrationAdjustment(const CalibrationOptions& options, int num_keyframes);

/// What became of an adjustment. A robust cost is half the sum of Huber's loss of the squared
/// errors of all observations of joint points, in units of sigma², and of the camera's χ² over the
/// information factor; an observation that does not project has the error kUnprojectableError.
struct AdjustmentSummary {
  AdjustmentStatus status = AdjustmentStatus::kNone;
  double initial_cost = 0;
  double final_cost = 0;  ///< Of a solver that did not fail.
  int num_observations = 0;
  int num_inliers = 0;       ///< Of them; below the 95% quantile afterwards.
  double inlier_rms_px = 0;  ///< Of the inliers' errors, both axes together, px.
  CameraParameters camera;   ///< The start, unless the status is usable.
  /// Of the camera, see CameraCovariance; empty covariance unless the status is usable.
  CameraEstimate estimate;

  bool is_usable() const { return IsUsable(status); }
};

/// Adjusts poses, points and the camera of bundles.
class BundleAdjuster {
 public:
  explicit BundleAdjuster(const AdjustmentOptions& options) : options_(options) {}

  /// Minimizes the robust reprojection error (Huber) over the free views and the points of bundles
  /// that were all seen by one camera, and over the camera: it is known as `prior` says, and sought
  /// from `start` on. The points are eliminated (Schur complement). Each bundle's gauge: its fixed
  /// views; with fewer than two of them the oldest view stays where it is, and the farthest keeps
  /// its distance from it. Afterwards observations over the 95% quantile of χ² are marked as
  /// outliers. Unless the status is usable the bundles are as they were. Deterministic. Throws
  /// corvo::Error on a prior that is not valid, and on a start that is not a camera.
  AdjustmentSummary Adjust(const CameraPrior& prior, const CameraParameters& start,
                           std::vector<Bundle>& bundles,
                           const AdjustmentProgress& progress = {}) const;

  /// The same for one bundle and a camera that is known exactly.
  AdjustmentSummary Adjust(const Camera& camera, Bundle& bundle) const;

 private:
  AdjustmentOptions options_;
};

}  // namespace corvo
