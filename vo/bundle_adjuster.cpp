#include "vo/bundle_adjuster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <ceres/ceres.h>

#include "vo/chi_square.h"
#include "vo/lie/se3_manifold.h"
#include "vo/pose_optimizer.h"
#include "vo/reprojection_cost.h"

namespace corvo {
namespace {

using PoseBlock = std::array<double, 7>;
using PointBlock = std::array<double, 3>;

/// The window's own copy of poses, points and observations, in the frame of its oldest keyframe.
struct Blocks {
  struct Term {
    int pose;
    int point;
    Observation observation;
    LandmarkId landmark;
    bool use = true;
  };

  SE3 world_from_local;
  std::vector<KeyframeId> keyframes;  // Ascending.
  std::vector<char> held;
  std::vector<PoseBlock> poses;
  std::vector<PointBlock> points;
  std::vector<Term> terms;
};

SE3 ToPose(const PoseBlock& block) { return SE3::FromData(block.data()); }
Eigen::Vector3d ToPoint(const PointBlock& block) {
  return Eigen::Map<const Eigen::Vector3d>(block.data());
}

void CopyKeyframes(const Map& map, const AdjustmentWindow& window, Blocks& blocks) {
  std::map<KeyframeId, bool> held;
  for (const KeyframeId id : window.moving) held[id] = false;
  for (const KeyframeId id : window.held) held[id] = true;
  blocks.world_from_local = map.WorldFromKeyframe(held.begin()->first);
  const SE3 local_from_world = blocks.world_from_local.Inverse();
  for (const auto& [id, is_held] : held) {
    const Eigen::Matrix<double, 7, 1> data = (local_from_world * map.WorldFromKeyframe(id)).data();
    PoseBlock block;
    std::copy(data.data(), data.data() + 7, block.begin());
    blocks.keyframes.push_back(id);
    blocks.held.push_back(is_held);
    blocks.poses.push_back(block);
  }
}

void CopyLandmarks(const Map& map, const AdjustmentWindow& window, Blocks& blocks) {
  const SE3 local_from_world = blocks.world_from_local.Inverse();
  for (const LandmarkId id : window.landmarks) {
    const Landmark& landmark = *map.FindLandmark(id);
    const Eigen::Vector3d in_local = local_from_world * landmark.in_world;
    const int point = static_cast<int>(blocks.points.size());
    blocks.points.push_back({in_local.x(), in_local.y(), in_local.z()});
    for (const Observation& observation : landmark.observations) {
      const auto found =
          std::lower_bound(blocks.keyframes.begin(), blocks.keyframes.end(), observation.keyframe);
      if (found == blocks.keyframes.end() || *found != observation.keyframe) continue;
      const int pose = static_cast<int>(found - blocks.keyframes.begin());
      blocks.terms.push_back({pose, point, observation, id});
    }
  }
}

PointObservation MeasurementOf(const Map& map, const Blocks& blocks, const Blocks::Term& term,
                               const KeypointNoise& noise) {
  const Frame& frame = map.keyframe(term.observation.keyframe).frame;
  const int k = term.observation.keypoint;
  return {ToPoint(blocks.points[term.point]), frame.pixel(k), noise.Sigma(frame.keypoint(k))};
}

/// Sets aside the terms over the 95% quantile, or, before the first solve, only those that do not
/// project at all.
void SetOutliersAside(const Map& map, const Camera& camera, const KeypointNoise& noise,
                      double max_squared_error, Blocks& blocks) {
  for (Blocks::Term& term : blocks.terms) {
    const double error = SquaredError(MeasurementOf(map, blocks, term, noise),
                                      ToPose(blocks.poses[term.pose]).Inverse(), camera);
    term.use = error <= max_squared_error;
  }
}

/// The pose farthest from the oldest one, whose distance determines the scale best.
double* FarthestPose(Blocks& blocks, const ceres::Problem& problem) {
  double* farthest = nullptr;
  double max_distance = 0;
  for (PoseBlock& pose : blocks.poses) {
    const double distance = ToPose(pose).translation().norm();
    if (distance <= max_distance || !problem.HasParameterBlock(pose.data())) continue;
    farthest = pose.data();
    max_distance = distance;
  }
  return farthest;
}

/// Holds poses: the held keyframes, or else the oldest one and the farthest one's distance from it.
void FixGauge(Blocks& blocks, ceres::Problem& problem) {
  const int num_held = static_cast<int>(std::count(blocks.held.begin(), blocks.held.end(), 1));
  for (std::size_t i = 0; i < blocks.poses.size(); ++i) {
    double* pose = blocks.poses[i].data();
    if (!problem.HasParameterBlock(pose)) continue;
    problem.SetManifold(pose, new SE3Manifold);
    if (blocks.held[i] || (num_held < 2 && i == 0)) problem.SetParameterBlockConstant(pose);
  }
  const bool scale_is_free = num_held == 0 || (num_held == 1 && blocks.held[0]);
  double* farthest = scale_is_free ? FarthestPose(blocks, problem) : nullptr;
  if (farthest == nullptr) return;
  problem.SetManifold(
      farthest,
      new ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::SphereManifold<3>>);
}

ceres::Solver::Options SolverOptions(int max_iterations) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = max_iterations;
  options.max_solver_time_in_seconds = 1e9;
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  return options;
}

ceres::Solver::Summary Solve(const Map& map, const Camera& camera, const KeypointNoise& noise,
                             bool robust, int max_iterations, Blocks& blocks) {
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::HuberLoss huber(std::sqrt(kChiSquare2Dof95));
  ceres::Problem problem(problem_options);
  for (const Blocks::Term& term : blocks.terms) {
    if (!term.use) continue;
    const PointObservation measured = MeasurementOf(map, blocks, term, noise);
    problem.AddResidualBlock(new ReprojectionCost(camera, measured.pixel, measured.sigma_px),
                             robust ? &huber : nullptr, blocks.poses[term.pose].data(),
                             blocks.points[term.point].data());
  }
  FixGauge(blocks, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(max_iterations), &problem, &summary);
  return summary;
}

void WriteBack(const Blocks& blocks, const AdjustmentWindow& window, Map& map) {
  for (std::size_t i = 0; i < blocks.poses.size(); ++i) {
    if (!blocks.held[i]) {
      map.SetPose(blocks.keyframes[i], blocks.world_from_local * ToPose(blocks.poses[i]));
    }
  }
  for (std::size_t i = 0; i < blocks.points.size(); ++i) {
    map.SetPosition(window.landmarks[i], blocks.world_from_local * ToPoint(blocks.points[i]));
  }
}

std::vector<Observation> RemoveOutliers(const Blocks& blocks, Map& map) {
  std::vector<Observation> removed;
  for (const Blocks::Term& term : blocks.terms) {
    if (term.use) continue;
    removed.push_back(term.observation);
    if (map.FindLandmark(term.landmark) != nullptr) {
      map.RemoveObservation(term.landmark, term.observation.keyframe);
    }
  }
  return removed;
}

}  // namespace

AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options) {
  std::set<KeyframeId> moving{newest};
  for (const Covisible& covisible : map.FindCovisible(newest, options.min_shared_landmarks)) {
    if (static_cast<int>(moving.size()) == options.max_keyframes) break;
    moving.insert(covisible.keyframe);
  }
  AdjustmentWindow window;
  window.moving.assign(moving.begin(), moving.end());
  window.landmarks = map.FindSeen(window.moving);
  std::map<KeyframeId, int> num_seen;
  for (const LandmarkId id : window.landmarks) {
    for (const Observation& o : map.FindLandmark(id)->observations) {
      if (moving.count(o.keyframe) == 0) ++num_seen[o.keyframe];
    }
  }
  for (const auto& [id, count] : num_seen) {
    if (count >= options.min_shared_landmarks) window.held.push_back(id);
  }
  return window;
}

AdjustmentResult AdjustBundle(Map& map, const AdjustmentWindow& window, const Camera& camera,
                              const KeypointNoise& noise, const BundleAdjusterOptions& options) {
  Blocks blocks;
  CopyKeyframes(map, window, blocks);
  CopyLandmarks(map, window, blocks);
  AdjustmentResult result;
  result.num_observations = static_cast<int>(blocks.terms.size());

  constexpr double kProjects = 1e12;
  SetOutliersAside(map, camera, noise, kProjects, blocks);
  const ceres::Solver::Summary first =
      Solve(map, camera, noise, true, options.robust_iterations, blocks);
  if (!first.IsSolutionUsable()) return result;
  SetOutliersAside(map, camera, noise, kChiSquare2Dof95, blocks);
  const ceres::Solver::Summary second =
      Solve(map, camera, noise, false, options.final_iterations, blocks);
  if (!second.IsSolutionUsable()) return result;
  SetOutliersAside(map, camera, noise, kChiSquare2Dof95, blocks);

  result.usable = true;
  result.initial_cost = first.initial_cost;
  result.final_cost = second.final_cost;
  WriteBack(blocks, window, map);
  result.outliers = RemoveOutliers(blocks, map);
  return result;
}

}  // namespace corvo
