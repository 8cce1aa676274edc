// SPDX-License-Identifier: MIT
#include "bench/calibration/camera_run.h"

#include <limits>
#include <vector>

#include "apps/run/outcome.h"
#include "orb/error.h"
#include "vo/evaluation/evaluation.h"
#include "vo/offline/refiner.h"

namespace corvo {

void to_json(nlohmann::json& json, const CameraEstimate& estimate) {
  const Eigen::MatrixXd& covariance = estimate.covariance;
  json["difference"] = std::vector<double>(estimate.difference.begin(), estimate.difference.end());
  json["covariance"] =
      std::vector<double>(covariance.data(), covariance.data() + covariance.size());
}

void from_json(const nlohmann::json& json, CameraEstimate& estimate) {
  const auto difference = json.at("difference").get<std::vector<double>>();
  const auto covariance = json.at("covariance").get<std::vector<double>>();
  const auto size = static_cast<Eigen::Index>(difference.size());
  estimate.difference = Eigen::Map<const Eigen::VectorXd>(difference.data(), size);
  estimate.covariance = Eigen::Map<const Eigen::MatrixXd>(covariance.data(), size, size);
}

}  // namespace corvo

namespace corvo::bench {
namespace {

double Ate(const Trajectory& trajectory, const PoseSequence& truth) {
  try {
    return Evaluate(trajectory.PosedFrames(), truth).absolute.rmse;
  } catch (const Error&) {  // Too few poses to align.
    return std::numeric_limits<double>::quiet_NaN();
  }
}

void AddRefined(const Odometry& odometry, const Refinement& refinement, const PoseSequence& truth,
                CameraRun& run) {
  if (!refinement.adjustment.is_usable()) return;
  run.refined_ate = Ate(refinement.trajectory, truth);
  if (refinement.adjustment.estimate.covariance.size() == 0) return;
  run.refined_estimate = {odometry.camera_prior().Difference(refinement.adjustment.camera),
                          refinement.adjustment.estimate.covariance};
}

}  // namespace

CameraRun RunWithCamera(const Recording& recording, const CameraPrior& prior,
                        const OdometryOptions& options, bool refine,
                        const std::function<void(const Odometry&)>& after_frame) {
  Odometry odometry(prior, options);
  ObservationLog log;
  if (refine) odometry.SetObservationCallback(log.Callback());
  for (int i = 0; i < recording.size(); ++i) {
    odometry.Process(recording.image(i), recording.times[i]);
    if (after_frame) after_frame(odometry);
  }
  const Trajectory trajectory = odometry.Finish();
  CameraRun run;
  run.ate = run.refined_ate = Ate(trajectory, recording.truth);
  run.posed_share = trajectory.PosedShare();
  run.segments = CountPosedSegments(trajectory);
  run.prior_rejected = odometry.prior_rejected();
  run.estimate = run.refined_estimate = odometry.camera_estimate();
  if (refine) AddRefined(odometry, Refine(odometry, log), recording.truth, run);
  return run;
}

}  // namespace corvo::bench
