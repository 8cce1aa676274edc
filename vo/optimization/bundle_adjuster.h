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

/// Called after each iteration with the share of the adjustment that is done, 0 to 1. Returns
/// whether to continue.
using AdjustmentProgress = std::function<bool(double)>;

/// Options of an adjustment of bundles. Adjustments of windows, estimates of the camera and global
/// adjustments differ only in these options and in what is free.
struct AdjustmentOptions {
  int num_rounds = 1;       ///< Outliers are excluded before each round but the first.
  int max_iterations = 30;  ///< Largest number of iterations of each round.
  double huber_sigmas = 1;  ///< Residual at which Huber's loss becomes linear.
  /// Observations with a larger residual are excluded before the first round; standard deviations.
  double max_initial_error_sigmas = std::numeric_limits<double>::infinity();
  /// Observations with a larger residual are excluded before each later round; standard deviations.
  double max_error_sigmas = 5;
  /// Weight of the observations' information relative to that of the camera's prior.
  double information_factor = 1;
  /// Number of points of each free view that are adjusted jointly with it, longest tracks first; 0
  /// means all. The other points are adjusted after each round, one at a time.
  int points_per_view = 0;
  int point_iterations = 5;   ///< Largest number of iterations of one of these points.
  int max_dense_views = 300;  ///< Sparse linear algebra is used for more views.

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// Returns the options for adjusting a window, given the user's options.
AdjustmentOptions WindowAdjustment(const BundleAdjusterOptions& options);
/// Returns the options for estimating the camera from the newest `num_keyframes` keyframes.
AdjustmentOptions CalibrationAdjustment(const CalibrationOptions& options, int num_keyframes);

/// The outcome of an adjustment. A robust cost is half the sum of Huber's loss of the squared
/// errors of all observations of joint points, in units of sigma², and of the camera's χ² over the
/// information factor. An observation whose point does not project has the error
/// kUnprojectableError.
struct AdjustmentSummary {
  AdjustmentStatus status = AdjustmentStatus::kNone;
  double initial_cost = 0;
  double final_cost = 0;  ///< Set only if the solver finished.
  int num_observations = 0;
  int num_inliers = 0;       ///< Observations within the 95% quantile after the adjustment.
  double inlier_rms_px = 0;  ///< RMS error of the inliers, both axes together, px.
  CameraParameters camera;   ///< The start unless the status is usable.
  /// The camera's estimate, see CameraCovariance. Its covariance is empty unless the status is
  /// usable.
  CameraEstimate estimate;

  bool is_usable() const { return IsUsable(status); }
};

/// Adjusts poses, points and the camera of bundles.
class BundleAdjuster {
 public:
  /// Throws corvo::Error naming the first option out of range.
  explicit BundleAdjuster(const AdjustmentOptions& options) : options_(options) {
    options.Validate();
  }

  /// Minimizes the robust reprojection error (Huber) over the free views, the points of bundles
  /// that were all observed by one camera, and the free parameters of the camera, which has the
  /// given prior and the initial value `start`. The points are eliminated (Schur complement). The
  /// gauge of each bundle is fixed by its fixed views. With fewer than two of them the oldest view
  /// is fixed as well; if it is then the only one, the farthest view keeps its distance from it.
  /// Afterwards observations over the 95% quantile of χ² are marked as outliers. The bundles are
  /// unchanged unless the status is usable. The result is deterministic. Throws corvo::Error if the
  /// prior is invalid or `start` is not a valid camera.
  AdjustmentSummary Adjust(const CameraPrior& prior, const CameraParameters& start,
                           std::vector<Bundle>& bundles,
                           const AdjustmentProgress& progress = {}) const;

  /// Like the above, but for one bundle and a camera that is known exactly.
  AdjustmentSummary Adjust(const Camera& camera, Bundle& bundle) const;

 private:
  AdjustmentOptions options_;
};

}  // namespace corvo
