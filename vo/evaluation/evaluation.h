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

/// An estimated pose and the true one of the same time. The two worlds differ until aligned.
struct PosePair {
  TimeNs time_ns = 0;  ///< Of the estimate.
  SE3 estimate_from_camera;
  SE3 truth_from_camera;
};

/// Half the median time from one pose to the next, which is half a frame for most estimates; 20 ms
/// for fewer than two poses.
TimeNs HalfFrame(const PoseSequence& poses);

/// Pairs every estimate with the truth nearest in time, at most `max_dt_ns` away (of two equally
/// near, the earlier). Where several estimates meet one truth, the nearest keeps it (or the
/// earlier). Ascending in time.
std::vector<PosePair> Associate(const PoseSequence& estimate, const PoseSequence& truth,
                                TimeNs max_dt_ns);

/// What an estimate may be moved by before it is compared.
enum class Alignment {
  kSim3,   ///< Scale, rotation and translation: monocular estimates.
  kSe3,    ///< Rotation and translation.
  kScale,  ///< The scale of kSim3, applied about the estimate's origin; nothing else.
  kNone,
};

/// "sim3", "se3", "scale", "none".
std::string_view ToString(Alignment alignment);
/// The alignment of that name. Throws corvo::Error on any other.
Alignment ParseAlignment(std::string_view name);

/// The transform that minimizes the sum of |truth - truth_from_estimate * estimate|² over the
/// positions (Umeyama 1991; its scale alone for kScale). Positions on one line leave the rotation
/// about it open, which does not change the positions' errors. Throws corvo::Error for fewer than 3
/// pairs or where all estimated, or all true, positions are equal; never for kNone.
Sim3 Align(const std::vector<PosePair>& pairs, Alignment alignment);

/// The pairs with estimates moved into the truth's world.
std::vector<PosePair> MoveEstimates(const Sim3& truth_from_estimate, std::vector<PosePair> pairs);

/// Of `count` values; NaN where there are none.
struct ErrorStatistics {
  int count = 0;
  double rmse = 0, mean = 0, median = 0, max = 0;
};

/// The median of an even count is the mean of the two in the middle.
ErrorStatistics Summarize(std::vector<double> errors);

/// Distances between estimated and true positions, in pair order.
std::vector<double> PositionErrors(const std::vector<PosePair>& aligned_pairs);

/// Errors of relative motion (RPE): of (true motion)⁻¹ (estimated motion) between two pairs.
/// Rotations neither depend on the alignment nor on the estimate's scale.
struct RelativeError {
  ErrorStatistics translation;  ///< Unit of the truth.
  ErrorStatistics rotation_deg;
};

/// From every pair to the one `delta` later, at least 1, overlapping (evo: `--delta_unit f
/// --all_pairs`). The estimates must have the truth's scale.
RelativeError RelativeErrorOverFrames(const std::vector<PosePair>& aligned_pairs, int delta);
/// From every pair to the first at least `delta_ns` > 0 later, if at most 1.5 times as much;
/// overlapping.
RelativeError RelativeErrorOverTime(const std::vector<PosePair>& aligned_pairs, TimeNs delta_ns);
/// Over stretches of the true path, one after the other: each ends at the first pair that lies at
/// least `delta` > 0 along the path from its start, and there the next starts (evo: `--delta_unit m
/// --pairs_from_reference`).
RelativeError RelativeErrorOverPath(const std::vector<PosePair>& aligned_pairs, double delta);

/// Drift over stretches of a fixed length, as the KITTI odometry benchmark defines it.
struct StretchDrift {
  double length_m = 0;
  int count = 0;
  double t_rel_percent = 0;
  double r_rel_deg_per_100m = 0;
};

struct KittiDrift {
  double t_rel_percent = 0;           ///< Mean over all stretches.
  double r_rel_deg_per_100m = 0;      ///< Mean over all stretches.
  std::vector<StretchDrift> lengths;  ///< Those of 100, 200 ... 800 m that occur.
};

/// Stretches start at every 10th pair and end at the first pair that lies more than their length
/// along the true path. None where the true path is shorter than 100 m. KITTI's truth is in meters.
std::optional<KittiDrift> ComputeKittiDrift(const std::vector<PosePair>& aligned_pairs);

/// Drift of the scale: the ratio of estimated to true path over the last third of the true path,
/// divided by the ratio over the first third. 1 is none.
struct ScaleDrift {
  double last_over_first = 1;
  double percent_per_km = 0;  ///< (last_over_first - 1) over the 2/3 of the true path between them.
};

/// None for fewer than 6 pairs, and where a third of either path has no length.
std::optional<ScaleDrift> ComputeScaleDrift(const std::vector<PosePair>& pairs);

/// Share of the truth's poses with an estimate at most `max_dt_ns` away, 0 to 1; 0 without truth.
double Coverage(const PoseSequence& estimate, const PoseSequence& truth, TimeNs max_dt_ns);

/// Sum of the distances between consecutive positions.
double PathLength(const PoseSequence& poses);

struct EvaluationOptions {
  Alignment alignment = Alignment::kSim3;
  std::optional<TimeNs> max_dt_ns;  ///< Between poses that are compared; none is HalfFrame().
  int relative_delta_frames = 1;
  TimeNs relative_delta_ns = 1'000'000'000;
  std::optional<double> relative_delta_path;  ///< Unit of the truth.
};

/// All measures of one estimate. Lengths are in the truth's unit.
struct Evaluation {
  EvaluationOptions options;  ///< As they were; max_dt_ns is always set.
  int num_pairs = 0;
  double coverage = 0;           ///< See Coverage().
  double truth_path_length = 0;  ///< Through the paired poses.
  Sim3 truth_from_estimate;
  std::vector<PosePair> aligned_pairs;
  ErrorStatistics absolute;                    ///< ATE: positions, after alignment.
  RelativeError relative_frames;               ///< Over relative_delta_frames.
  RelativeError relative_time;                 ///< Over relative_delta_ns.
  std::optional<RelativeError> relative_path;  ///< Over relative_delta_path.
  std::optional<KittiDrift> kitti;
  std::optional<ScaleDrift> scale_drift;
};

/// Throws corvo::Error where nothing can be said: no pair of poses near in time, or no
/// alignment.
Evaluation Evaluate(const PoseSequence& estimate, const PoseSequence& truth,
                    const EvaluationOptions& options = {});

}  // namespace corvo
