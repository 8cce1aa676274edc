// SPDX-License-Identifier: MIT
#include "vo/evaluation/time_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "orb/error.h"
#include "vo/evaluation/evaluation.h"

namespace corvo {
namespace {

constexpr int kMinPoses = 10;
constexpr int kMaxPoses = 200;         ///< Poses of the estimate that are compared; evenly spread.
constexpr int kMaxCoarseSteps = 2000;  ///< Number of offsets of the coarse search.
constexpr double kMinOverlap = 0.8;    ///< Share of the shorter trajectory.
constexpr double kMaxErrorRatio = 0.5;
constexpr double kMaxErrorShare = 0.1;      ///< Of the extent of the ground truth.
constexpr double kRoundingShare = 1e-9;     ///< Of the same; smaller errors are those of rounding.
constexpr double kMaxAmbiguousShare = 0.2;  ///< Of the offsets that fit as well as the best.
constexpr TimeNs kMaxOffsetOfOverlap = 5'000'000'000;
constexpr double kNoMatch = std::numeric_limits<double>::infinity();

PoseSequence Spread(const PoseSequence& poses) {
  const std::size_t count = std::min<std::size_t>(poses.size(), kMaxPoses);
  PoseSequence spread;
  for (std::size_t i = 0; i < count; ++i) spread.push_back(poses[i * poses.size() / count]);
  return spread;
}

/// Returns the position at a time, interpolated between the poses before and after it, or
/// std::nullopt outside of the trajectory.
std::optional<Eigen::Vector3d> PositionAt(const PoseSequence& poses, TimeNs time_ns) {
  const auto later =
      std::lower_bound(poses.begin(), poses.end(), time_ns,
                       [](const TimedPose& pose, TimeNs time) { return pose.time_ns < time; });
  if (later == poses.end()) return std::nullopt;
  if (later->time_ns == time_ns) return later->world_from_camera.translation();
  if (later == poses.begin()) return std::nullopt;
  const TimedPose& before = *std::prev(later);
  const double share = static_cast<double>(time_ns - before.time_ns) /
                       static_cast<double>(later->time_ns - before.time_ns);
  return (1 - share) * before.world_from_camera.translation() +
         share * later->world_from_camera.translation();
}

/// Returns the root mean square distance of the ground truth's positions from their mean.
double ExtentOf(const std::vector<PosePair>& pairs) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) mean += pair.truth_from_camera.translation();
  mean /= static_cast<double>(std::max<std::size_t>(1, pairs.size()));
  double sum = 0;
  for (const PosePair& pair : pairs) {
    sum += (pair.truth_from_camera.translation() - mean).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, pairs.size())));
}

/// The errors of an estimate's poses with the ground truth at shifted times.
class OffsetErrors {
 public:
  OffsetErrors(const PoseSequence& estimate, const PoseSequence& truth)
      : estimate_(Spread(estimate)), truth_(truth) {}

  /// Returns the pairs of the poses that have ground truth with every one of `offsets`; the pairs
  /// are those of the first offset.
  std::vector<PosePair> Pairs(const std::vector<TimeNs>& offsets) const {
    std::vector<PosePair> pairs;
    for (const TimedPose& pose : estimate_) {
      const bool has_all = std::all_of(offsets.begin(), offsets.end(), [&](TimeNs offset) {
        return PositionAt(truth_, pose.time_ns + offset).has_value();
      });
      if (!has_all) continue;
      const Eigen::Vector3d position = *PositionAt(truth_, pose.time_ns + offsets[0]);
      pairs.push_back({pose.time_ns, pose.world_from_camera, SE3(SO3(), position)});
    }
    return pairs;
  }

  /// Returns the ATE, but at least what rounding may cause, or infinity if there are too few pairs.
  double Of(const std::vector<TimeNs>& offsets) const {
    const std::vector<PosePair> pairs = Pairs(offsets);
    if (static_cast<double>(pairs.size()) < NumNeeded()) return kNoMatch;
    try {
      const Sim3 aligned = Align(pairs, Alignment::kSim3);
      const double rmse = Summarize(PositionErrors(MoveEstimates(aligned, pairs))).rmse;
      return std::max(rmse, kRoundingShare * ExtentOf(pairs));
    } catch (const Error&) {  // All positions are equal.
      return kNoMatch;
    }
  }

 private:
  /// Returns the number of poses that make up kMinOverlap of the shorter trajectory.
  double NumNeeded() const {
    const double estimated = ToSeconds(estimate_.back().time_ns - estimate_.front().time_ns);
    const double true_span = ToSeconds(truth_.back().time_ns - truth_.front().time_ns);
    const double share = std::min(1.0, true_span / estimated);
    return std::max<double>(kMinPoses, kMinOverlap * share * static_cast<double>(estimate_.size()));
  }

  PoseSequence estimate_;
  const PoseSequence& truth_;
};

/// An offset and the errors of those that were tried.
struct CoarseSearch {
  TimeNs best_ns = 0;
  TimeNs step_ns = 1;
  double rmse = kNoMatch;
  std::vector<double> errors;

  bool IsAmbiguous() const {
    const auto fits = std::count_if(errors.begin(), errors.end(),
                                    [&](double error) { return error <= 2 * rmse; });
    return static_cast<double>(fits) > kMaxAmbiguousShare * static_cast<double>(errors.size());
  }
};

CoarseSearch Search(const OffsetErrors& errors, TimeNs first_ns, TimeNs last_ns, TimeNs step_ns) {
  CoarseSearch search;
  search.step_ns = std::max({TimeNs{1000}, step_ns, (last_ns - first_ns) / kMaxCoarseSteps});
  for (TimeNs offset = first_ns; offset <= last_ns; offset += search.step_ns) {
    const double error = errors.Of({offset});
    if (std::isfinite(error)) search.errors.push_back(error);
    if (error >= search.rmse) continue;
    search.rmse = error;
    search.best_ns = offset;
  }
  return search;
}

/// Refines the best offset by halving the step.
void Refine(const OffsetErrors& errors, CoarseSearch& search) {
  constexpr TimeNs kFinestNs = 100'000;
  for (TimeNs step = search.step_ns / 2; step >= kFinestNs; step /= 2) {
    for (const TimeNs offset : {search.best_ns - step, search.best_ns + step}) {
      const double error = errors.Of({offset});
      if (error >= search.rmse) continue;
      search.rmse = error;
      search.best_ns = offset;
      break;
    }
  }
}

}  // namespace

std::optional<TimeOffset> FindTimeOffset(const PoseSequence& estimate, const PoseSequence& truth) {
  if (estimate.size() < kMinPoses || truth.size() < kMinPoses) return std::nullopt;
  const auto is_in_range = [](const PoseSequence& poses) {  // So that no difference overflows.
    return poses.front().time_ns > -kMaxTimeNs / 2 && poses.back().time_ns < kMaxTimeNs / 2;
  };
  if (!is_in_range(estimate) || !is_in_range(truth)) return std::nullopt;
  const OffsetErrors errors(estimate, truth);
  const bool overlaps = std::isfinite(errors.Of({0}));
  TimeNs first = truth.front().time_ns - estimate.back().time_ns;
  TimeNs last = truth.back().time_ns - estimate.front().time_ns;
  if (overlaps) {
    first = std::max(first, -kMaxOffsetOfOverlap);
    last = std::min(last, kMaxOffsetOfOverlap);
  }
  const TimeNs frame_ns = 2 * HalfFrame(estimate);
  CoarseSearch search = Search(errors, first, last, frame_ns);
  if (search.errors.empty()) return std::nullopt;
  const bool is_ambiguous = search.IsAmbiguous();
  Refine(errors, search);
  TimeOffset found{search.best_ns, search.rmse, std::nullopt};
  const double extent = ExtentOf(errors.Pairs({found.offset_ns}));
  if (found.rmse > kMaxErrorShare * extent) return std::nullopt;
  if (!overlaps) return is_ambiguous ? std::nullopt : std::optional(found);
  if (4 * std::abs(found.offset_ns) < frame_ns) return std::nullopt;
  found.rmse = errors.Of({found.offset_ns, 0});
  found.rmse_without = errors.Of({0, found.offset_ns});
  const bool is_better = found.rmse < kMaxErrorRatio * *found.rmse_without;
  if (!is_better || !std::isfinite(*found.rmse_without)) return std::nullopt;
  return found;
}

PoseSequence ShiftTimes(TimeNs offset_ns, PoseSequence poses) {
  CheckRange("time offset in ns", offset_ns, 1 - kMaxTimeNs, kMaxTimeNs - 1);
  for (TimedPose& pose : poses) {
    CheckRange("time of a pose in ns", pose.time_ns, -kMaxTimeNs, kMaxTimeNs);
    pose.time_ns += offset_ns;
    CheckRange("time of a pose with the offset in ns", pose.time_ns, -kMaxTimeNs, kMaxTimeNs);
  }
  return poses;
}

}  // namespace corvo
