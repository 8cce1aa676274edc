// SPDX-License-Identifier: MIT
#include "vo/evaluation/evaluation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "orb/error.h"

namespace corvo {
namespace {

constexpr double kDegreesPerRadian = 180 / 3.14159265358979323846;
constexpr double kMetersPerKilometer = 1000;

/// Returns the distance in time without overflow.
std::uint64_t TimeBetween(TimeNs a, TimeNs b) {
  return a > b ? static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b)
               : static_cast<std::uint64_t>(b) - static_cast<std::uint64_t>(a);
}

/// Returns the index of the pose nearest in time (the earlier of two equally near), or kNoId if
/// there is none.
int NearestInTime(const PoseSequence& poses, TimeNs time_ns) {
  if (poses.empty()) return kNoId;
  const auto later =
      std::lower_bound(poses.begin(), poses.end(), time_ns,
                       [](const TimedPose& pose, TimeNs time) { return pose.time_ns < time; });
  const int index = static_cast<int>(later - poses.begin());
  if (later == poses.begin()) return 0;
  if (later == poses.end()) return index - 1;
  const bool earlier_is_nearer =
      TimeBetween(poses[index - 1].time_ns, time_ns) <= TimeBetween(poses[index].time_ns, time_ns);
  return earlier_is_nearer ? index - 1 : index;
}

/// Like NearestInTime(), but returns kNoId if the pose is more than `max_dt_ns` away.
int NearestWithin(const PoseSequence& poses, TimeNs time_ns, TimeNs max_dt_ns) {
  const int nearest = NearestInTime(poses, time_ns);
  if (nearest == kNoId || max_dt_ns < 0) return kNoId;
  const bool within =
      TimeBetween(poses[nearest].time_ns, time_ns) <= static_cast<std::uint64_t>(max_dt_ns);
  return within ? nearest : kNoId;
}

/// Throws corvo::Error naming the first pose that is not finite or out of range.
void CheckPoses(std::string_view name, const PoseSequence& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string pose = fmt::format("pose {} of the {}", i, name);
    CheckRange(pose + ": time in ns", poses[i].time_ns, -kMaxTimeNs, kMaxTimeNs);
    CheckPose(pose, poses[i].world_from_camera);
  }
}

/// The positions of pairs, one in each column.
struct Positions {
  Eigen::Matrix3Xd estimate, truth;
};

Positions PositionsOf(const std::vector<PosePair>& pairs) {
  Positions positions{Eigen::Matrix3Xd(3, pairs.size()), Eigen::Matrix3Xd(3, pairs.size())};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    positions.estimate.col(i) = pairs[i].estimate_from_camera.translation();
    positions.truth.col(i) = pairs[i].truth_from_camera.translation();
  }
  return positions;
}

void CheckAlignable(const Positions& positions) {
  const Eigen::Index count = positions.estimate.cols();
  if (count < 3) {
    throw Error(fmt::format("alignment needs 3 pairs of poses or more; there are {}", count));
  }
  const auto all_equal = [](const Eigen::Matrix3Xd& points) {
    // The squares of smaller distances would underflow.
    constexpr double kLeastDistance = 1e-100;
    return (points.colwise() - points.col(0)).cwiseAbs().maxCoeff() <=
           std::max(kLeastDistance, 1e-12 * points.cwiseAbs().maxCoeff());
  };
  if (all_equal(positions.estimate)) throw Error("alignment: all estimated positions are equal");
  if (all_equal(positions.truth)) throw Error("alignment: all true positions are equal");
}

/// Aligns positions by Umeyama, "Least-squares estimation of transformation parameters between two
/// point patterns", 1991, eq. 40-43.
Sim3 Umeyama(const Positions& positions, bool with_scale) {
  const Eigen::Vector3d estimate_mean = positions.estimate.rowwise().mean();
  const Eigen::Vector3d truth_mean = positions.truth.rowwise().mean();
  const Eigen::Matrix3Xd estimate = positions.estimate.colwise() - estimate_mean;
  const Eigen::Matrix3Xd truth = positions.truth.colwise() - truth_mean;
  const Eigen::Matrix3d covariance = truth * estimate.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;
  const SO3 rotation(
      Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
  const double scale = with_scale ? svd.singularValues().dot(signs) / estimate.squaredNorm() : 1.0;
  return Sim3(scale, rotation, truth_mean - scale * (rotation * estimate_mean));
}

/// Returns (true motion)⁻¹ (estimated motion) between two pairs.
SE3 MotionError(const PosePair& from, const PosePair& to) {
  const SE3 truth = from.truth_from_camera.Inverse() * to.truth_from_camera;
  const SE3 estimate = from.estimate_from_camera.Inverse() * to.estimate_from_camera;
  return truth.Inverse() * estimate;
}

/// Returns the errors of motions between pairs, which are given by their indices.
RelativeError SummarizeMotions(const std::vector<PosePair>& pairs,
                               const std::vector<std::pair<int, int>>& motions) {
  std::vector<double> translations, rotations_deg;
  for (const auto& [from, to] : motions) {
    const SE3 error = MotionError(pairs[from], pairs[to]);
    translations.push_back(error.translation().norm());
    rotations_deg.push_back(error.rotation().Angle() * kDegreesPerRadian);
  }
  return {Summarize(std::move(translations)), Summarize(std::move(rotations_deg))};
}

/// Returns the path length from the first pair to each pair.
std::vector<double> PathTo(const std::vector<PosePair>& pairs, SE3 PosePair::*pose) {
  std::vector<double> path(pairs.size(), 0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Eigen::Vector3d step =
        (pairs[i].*pose).translation() - (pairs[i - 1].*pose).translation();
    path[i] = path[i - 1] + step.norm();
  }
  return path;
}

/// The sums over stretches of one length.
struct StretchSum {
  int count = 0;
  double translation = 0;   ///< Translation error per length.
  double rotation_rad = 0;  ///< Rotation error per meter.

  void Add(const StretchSum& other) {
    count += other.count;
    translation += other.translation;
    rotation_rad += other.rotation_rad;
  }

  StretchDrift Mean(double length_m) const {
    return {length_m, count, 100 * translation / count,
            100 * kDegreesPerRadian * rotation_rad / count};
  }
};

StretchSum SumStretches(const std::vector<PosePair>& pairs, const std::vector<double>& path,
                        double length_m) {
  constexpr std::size_t kStep = 10;
  StretchSum sum;
  for (std::size_t first = 0; first < pairs.size(); first += kStep) {
    const auto last = std::upper_bound(path.begin() + first, path.end(), path[first] + length_m);
    if (last == path.end()) break;
    const SE3 error = MotionError(pairs[first], pairs[last - path.begin()]);
    sum.Add({1, error.translation().norm() / length_m, error.rotation().Angle() / length_m});
  }
  return sum;
}

}  // namespace

std::string_view ToString(Alignment alignment) {
  switch (alignment) {
    case Alignment::kSim3:
      return "sim3";
    case Alignment::kSe3:
      return "se3";
    case Alignment::kScale:
      return "scale";
    case Alignment::kNone:
      return "none";
  }
  return "unknown";
}

Alignment ParseAlignment(std::string_view name) {
  for (const Alignment alignment :
       {Alignment::kSim3, Alignment::kSe3, Alignment::kScale, Alignment::kNone}) {
    if (name == ToString(alignment)) return alignment;
  }
  throw Error(fmt::format("alignment is \"{}\"; allowed is sim3, se3, scale or none", name));
}

TimeNs HalfFrame(const PoseSequence& poses) {
  constexpr TimeNs kWithoutFrames = 20'000'000;
  std::vector<std::uint64_t> steps;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    steps.push_back(TimeBetween(poses[i].time_ns, poses[i - 1].time_ns));
  }
  if (steps.empty()) return kWithoutFrames;
  const auto median = steps.begin() + steps.size() / 2;
  std::nth_element(steps.begin(), median, steps.end());
  return static_cast<TimeNs>(*median / 2);
}

std::vector<PosePair> Associate(const PoseSequence& estimate, const PoseSequence& truth,
                                TimeNs max_dt_ns) {
  std::map<int, int> estimate_of_truth;
  for (int i = 0; i < static_cast<int>(estimate.size()); ++i) {
    const int nearest = NearestWithin(truth, estimate[i].time_ns, max_dt_ns);
    if (nearest == kNoId) continue;
    const auto [entry, is_new] = estimate_of_truth.try_emplace(nearest, i);
    const TimeNs time_ns = truth[nearest].time_ns;
    const bool nearer = TimeBetween(estimate[i].time_ns, time_ns) <
                        TimeBetween(estimate[entry->second].time_ns, time_ns);
    if (nearer) entry->second = i;
  }
  std::vector<PosePair> pairs;
  pairs.reserve(estimate_of_truth.size());
  for (const auto& [truth_index, index] : estimate_of_truth) {
    pairs.push_back({estimate[index].time_ns, estimate[index].world_from_camera,
                     truth[truth_index].world_from_camera});
  }
  return pairs;
}

Sim3 Align(const std::vector<PosePair>& pairs, Alignment alignment) {
  if (alignment == Alignment::kNone) return Sim3();
  const Positions positions = PositionsOf(pairs);
  CheckAlignable(positions);
  Sim3 truth_from_estimate = Umeyama(positions, alignment != Alignment::kSe3);
  if (alignment != Alignment::kScale) return truth_from_estimate;
  return Sim3(truth_from_estimate.scale(), SO3(), Eigen::Vector3d::Zero());
}

std::vector<PosePair> MoveEstimates(const Sim3& truth_from_estimate, std::vector<PosePair> pairs) {
  for (PosePair& pair : pairs) {
    pair.estimate_from_camera = TransformPose(truth_from_estimate, pair.estimate_from_camera);
  }
  return pairs;
}

ErrorStatistics Summarize(std::vector<double> errors) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (errors.empty()) return {0, kNaN, kNaN, kNaN, kNaN};
  std::sort(errors.begin(), errors.end());
  const Eigen::Map<const Eigen::ArrayXd> values(errors.data(), errors.size());
  const std::size_t middle = errors.size() / 2;
  ErrorStatistics statistics;
  statistics.count = static_cast<int>(errors.size());
  statistics.rmse = std::sqrt(values.square().mean());
  statistics.mean = values.mean();
  statistics.median =
      errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  statistics.max = errors.back();
  return statistics;
}

std::vector<double> PositionErrors(const std::vector<PosePair>& aligned_pairs) {
  std::vector<double> errors;
  errors.reserve(aligned_pairs.size());
  for (const PosePair& pair : aligned_pairs) {
    errors.push_back(
        (pair.estimate_from_camera.translation() - pair.truth_from_camera.translation()).norm());
  }
  return errors;
}

RelativeError RelativeErrorOverFrames(const std::vector<PosePair>& aligned_pairs, int delta) {
  CheckRange("delta", delta, 1, std::numeric_limits<int>::max());
  std::vector<std::pair<int, int>> motions;
  for (int to = delta; to < static_cast<int>(aligned_pairs.size()); ++to) {
    motions.emplace_back(to - delta, to);
  }
  return SummarizeMotions(aligned_pairs, motions);
}

RelativeError RelativeErrorOverTime(const std::vector<PosePair>& aligned_pairs, TimeNs delta_ns) {
  CheckRange("delta_ns", delta_ns, TimeNs{1}, std::numeric_limits<TimeNs>::max());
  std::vector<std::pair<int, int>> motions;
  int to = 0;
  for (int from = 0; from < static_cast<int>(aligned_pairs.size()); ++from) {
    const auto span_ns = [&] { return aligned_pairs[to].time_ns - aligned_pairs[from].time_ns; };
    while (to < static_cast<int>(aligned_pairs.size()) && span_ns() < delta_ns) ++to;
    if (to == static_cast<int>(aligned_pairs.size())) break;
    if (span_ns() - delta_ns <= delta_ns / 2) motions.emplace_back(from, to);
  }
  return SummarizeMotions(aligned_pairs, motions);
}

RelativeError RelativeErrorOverPath(const std::vector<PosePair>& aligned_pairs, double delta) {
  CheckPositive("delta", delta);
  const std::vector<double> path = PathTo(aligned_pairs, &PosePair::truth_from_camera);
  std::vector<std::pair<int, int>> motions;
  int from = 0;
  for (int to = 1; to < static_cast<int>(aligned_pairs.size()); ++to) {
    if (path[to] - path[from] < delta) continue;
    motions.emplace_back(from, to);
    from = to;
  }
  return SummarizeMotions(aligned_pairs, motions);
}

std::optional<KittiDrift> ComputeKittiDrift(const std::vector<PosePair>& aligned_pairs) {
  const std::vector<double> path = PathTo(aligned_pairs, &PosePair::truth_from_camera);
  StretchSum total;
  KittiDrift drift;
  for (int length_m = 100; length_m <= 800; length_m += 100) {
    const StretchSum sum = SumStretches(aligned_pairs, path, length_m);
    if (sum.count > 0) drift.lengths.push_back(sum.Mean(length_m));
    total.Add(sum);
  }
  if (total.count == 0) return std::nullopt;
  const StretchDrift mean = total.Mean(0);
  drift.t_rel_percent = mean.t_rel_percent;
  drift.r_rel_deg_per_100m = mean.r_rel_deg_per_100m;
  return drift;
}

std::optional<ScaleDrift> ComputeScaleDrift(const std::vector<PosePair>& pairs) {
  if (pairs.size() < 6) return std::nullopt;
  const std::vector<double> truth = PathTo(pairs, &PosePair::truth_from_camera);
  const std::vector<double> estimate = PathTo(pairs, &PosePair::estimate_from_camera);
  const auto index_at = [&](double share) {
    return std::lower_bound(truth.begin(), truth.end(), share * truth.back()) - truth.begin();
  };
  const auto a = index_at(1.0 / 3), b = index_at(2.0 / 3);
  const double first_ratio = estimate[a] / truth[a];
  const double last_ratio = (estimate.back() - estimate[b]) / (truth.back() - truth[b]);
  const double last_over_first = last_ratio / first_ratio;
  if (!std::isfinite(last_over_first) || last_over_first <= 0) return std::nullopt;
  const double apart_km = 2.0 / 3 * truth.back() / kMetersPerKilometer;
  return ScaleDrift{last_over_first, 100 * (last_over_first - 1) / apart_km};
}

double Coverage(const PoseSequence& estimate, const PoseSequence& truth, TimeNs max_dt_ns) {
  if (truth.empty()) return 0;
  const auto covered = std::count_if(truth.begin(), truth.end(), [&](const TimedPose& pose) {
    return NearestWithin(estimate, pose.time_ns, max_dt_ns) != kNoId;
  });
  return static_cast<double>(covered) / static_cast<double>(truth.size());
}

double PathLength(const PoseSequence& poses) {
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length +=
        (poses[i].world_from_camera.translation() - poses[i - 1].world_from_camera.translation())
            .norm();
  }
  return length;
}

Evaluation Evaluate(const PoseSequence& estimate, const PoseSequence& truth,
                    const EvaluationOptions& options) {
  CheckPoses("estimate", estimate);
  CheckPoses("ground truth", truth);
  const TimeNs max_dt_ns = options.max_dt_ns.value_or(HalfFrame(estimate));
  const std::vector<PosePair> pairs = Associate(estimate, truth, max_dt_ns);
  if (pairs.empty()) {
    throw Error(fmt::format("no pose of {} lies within {} s of one of the truth's {}",
                            estimate.size(), ToSeconds(max_dt_ns), truth.size()));
  }
  Evaluation evaluation;
  evaluation.options = options;
  evaluation.options.max_dt_ns = max_dt_ns;
  evaluation.num_pairs = static_cast<int>(pairs.size());
  evaluation.coverage = Coverage(estimate, truth, max_dt_ns);
  evaluation.truth_path_length = PathTo(pairs, &PosePair::truth_from_camera).back();
  evaluation.truth_from_estimate = Align(pairs, options.alignment);
  evaluation.aligned_pairs = MoveEstimates(evaluation.truth_from_estimate, pairs);
  evaluation.absolute = Summarize(PositionErrors(evaluation.aligned_pairs));
  evaluation.relative_frames =
      RelativeErrorOverFrames(evaluation.aligned_pairs, options.relative_delta_frames);
  evaluation.relative_time =
      RelativeErrorOverTime(evaluation.aligned_pairs, options.relative_delta_ns);
  if (options.relative_delta_path) {
    evaluation.relative_path =
        RelativeErrorOverPath(evaluation.aligned_pairs, *options.relative_delta_path);
  }
  evaluation.kitti = ComputeKittiDrift(evaluation.aligned_pairs);
  evaluation.scale_drift = ComputeScaleDrift(evaluation.aligned_pairs);
  return evaluation;
}

}  // namespace corvo
