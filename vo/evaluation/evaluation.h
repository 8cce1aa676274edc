// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "vo/core/conventions.h"
#include "vo/core/trajectory.h"
#include "vo/lie/se3.h"
#include "vo/lie/sim3.h"

namespace corvo {

/// An estimated pose and the ground-truth pose of the same time. Their worlds differ until aligned.
struct PosePair {
  TimeNs time_ns = 0;  ///< Timestamp of the estimate.
  SE3 estimate_from_camera;
  SE3 truth_from_camera;
};

/// Returns half the median time from one pose to the next, which is half a frame for most
/// estimates, or 20 ms for fewer than two poses.
TimeNs HalfFrame(const PoseSequence& poses);

/// Pairs every estimate with the ground truth nearest in time, at most `max_dt_ns` away (the
/// earlier of two equally near). If several estimates have the same ground truth, only the nearest
/// (or the earlier) is paired. The pairs are in ascending order of time.
std::vector<PosePair> Associate(const PoseSequence& estimate, const PoseSequence& truth,
                                TimeNs max_dt_ns);

/// The transform by which an estimate is aligned before it is compared.
enum class Alignment {
  kSim3,   ///< Scale, rotation and translation, for monocular estimates.
  kSe3,    ///< Rotation and translation.
  kScale,  ///< Only the scale of kSim3, applied about the estimate's origin.
  kNone,
};

/// Returns "sim3", "se3", "scale" or "none".
std::string_view ToString(Alignment alignment);
/// Returns the alignment of that name. Throws corvo::Error if there is none.
Alignment ParseAlignment(std::string_view name);

/// Returns the transform that minimizes the sum of |truth - truth_from_estimate * estimate|² over
/// the positions (Umeyama 1991; its scale alone for kScale). Collinear positions leave the rotation
/// about their line undetermined, which does not affect position errors. Throws corvo::Error for
/// fewer than 3 pairs and if all estimated, or all true, positions are equal; never for kNone.
Sim3 Align(const std::vector<PosePair>& pairs, Alignment alignment);

/// Returns the pairs with estimates transformed to the world of the ground truth.
std::vector<PosePair> MoveEstimates(const Sim3& truth_from_estimate, std::vector<PosePair> pairs);

/// Statistics of `count` errors; NaN if there are none.
struct ErrorStatistics {
  int count = 0;
  double rmse = 0, mean = 0, median = 0, max = 0;
};

/// Returns the statistics of errors. The median of an even count is the mean of the two middle
/// values.
ErrorStatistics Summarize(std::vector<double> errors);

/// Returns the distances between estimated and true positions, in the order of the pairs.
std::vector<double> PositionErrors(const std::vector<PosePair>& aligned_pairs);

/// The relative pose errors (RPE): statistics of (true motion)⁻¹ (estimated motion) between two
/// pairs. Rotation errors depend neither on the alignment nor on the estimate's scale.
struct RelativeError {
  ErrorStatistics translation;  ///< Unit of the ground truth.
  ErrorStatistics rotation_deg;
};

/// Returns the errors from every pair to the one `delta` >= 1 pairs later, overlapping (evo:
/// `--delta_unit f --all_pairs`). The estimates must have the scale of the ground truth.
RelativeError RelativeErrorOverFrames(const std::vector<PosePair>& aligned_pairs, int delta);
/// Returns the errors from every pair to the first one that is at least `delta_ns` > 0 later, if it
/// is at most 1.5 times as much later; overlapping.
RelativeError RelativeErrorOverTime(const std::vector<PosePair>& aligned_pairs, TimeNs delta_ns);
/// Returns the errors over consecutive stretches of the true path: each ends at the first pair that
/// lies at least `delta` > 0 along the path from its start, where the next one starts (evo:
/// `--delta_unit m --pairs_from_reference`).
RelativeError RelativeErrorOverPath(const std::vector<PosePair>& aligned_pairs, double delta);

/// The drift over stretches of a fixed length, as the KITTI odometry benchmark defines it.
struct StretchDrift {
  double length_m = 0;
  int count = 0;
  double t_rel_percent = 0;
  double r_rel_deg_per_100m = 0;
};

struct KittiDrift {
  double t_rel_percent = 0;           ///< Mean over all stretches.
  double r_rel_deg_per_100m = 0;      ///< Mean over all stretches.
  std::vector<StretchDrift> lengths;  ///< Drift for each length of 100, 200 ... 800 m that occurs.
};

/// Returns the drift over stretches that start at every 10th pair and end at the first pair that
/// lies more than their length along the true path, or std::nullopt if the true path is not
/// longer than 100 m. KITTI's ground truth is in meters.
std::optional<KittiDrift> ComputeKittiDrift(const std::vector<PosePair>& aligned_pairs);

/// The drift of the scale: the ratio of estimated to true path length over the last third of the
/// true path, divided by the ratio over the first third. Without drift it is 1.
struct ScaleDrift {
  double last_over_first = 1;
  double percent_per_km = 0;  ///< (last_over_first - 1) over the 2/3 of the true path between them.
};

/// Returns the drift of the scale, or std::nullopt for fewer than 6 pairs or if a third of either
/// path has no length.
std::optional<ScaleDrift> ComputeScaleDrift(const std::vector<PosePair>& pairs);

/// Returns the share of the ground truth's poses with an estimate at most `max_dt_ns` away, 0 to 1;
/// 0 without ground truth.
double Coverage(const PoseSequence& estimate, const PoseSequence& truth, TimeNs max_dt_ns);

/// Returns the sum of the distances between consecutive positions.
double PathLength(const PoseSequence& poses);

struct EvaluationOptions {
  Alignment alignment = Alignment::kSim3;
  std::optional<TimeNs> max_dt_ns;  ///< Largest time between paired poses; HalfFrame() if not set.
  int relative_delta_frames = 1;
  TimeNs relative_delta_ns = 1'000'000'000;
  std::optional<double> relative_delta_path;  ///< Unit of the ground truth.
};

/// All measures of one estimate. Lengths are in the unit of the ground truth.
struct Evaluation {
  EvaluationOptions options;  ///< Options as given, with max_dt_ns set.
  int num_pairs = 0;
  double coverage = 0;           ///< See Coverage().
  double truth_path_length = 0;  ///< Path length through the paired true poses.
  Sim3 truth_from_estimate;
  std::vector<PosePair> aligned_pairs;
  ErrorStatistics absolute;                    ///< ATE: position errors after alignment.
  RelativeError relative_frames;               ///< RPE over relative_delta_frames.
  RelativeError relative_time;                 ///< RPE over relative_delta_ns.
  std::optional<RelativeError> relative_path;  ///< RPE over relative_delta_path.
  std::optional<KittiDrift> kitti;
  std::optional<ScaleDrift> scale_drift;
};

/// Evaluates an estimate against the ground truth. Throws corvo::Error if a pose is not finite or
/// out of range (see CheckPose() and kMaxTimeNs), if no poses are near each other in time, or if
/// they cannot be aligned.
Evaluation Evaluate(const PoseSequence& estimate, const PoseSequence& truth,
                    const EvaluationOptions& options = {});

}  // namespace corvo
