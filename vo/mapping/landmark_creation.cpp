// SPDX-License-Identifier: MIT
#include "vo/mapping/landmark_creation.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "orb/edge_response.h"
#include "vo/geometry/triangulation.h"
#include "vo/map/landmark_alignment.h"
#include "vo/mapping/epipolar_matching.h"
#include "vo/math/chi_square.h"
#include "vo/math/median.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

/// A keypoint of a frame that may observe a new point.
struct View {
  const Frame& frame;
  int keypoint;
};

bool FitsView(const Eigen::Vector3d& in_world, const View& view, const MeasurementModel& model) {
  const Eigen::Vector3d in_camera = view.frame.world_from_camera.Inverse() * in_world;
  const Observation observation = Observe(view.frame, view.keypoint, model);
  return SquaredError(in_camera, observation, model.camera) <= kChiSquare2Dof95;
}

std::optional<Eigen::Vector3d> TriangulateViews(const View& a, const View& b,
                                                const MeasurementModel& model,
                                                double min_parallax) {
  const PosedRay ray_a{a.frame.world_from_camera, a.frame.rays[a.keypoint]};
  const PosedRay ray_b{b.frame.world_from_camera, b.frame.rays[b.keypoint]};
  const double coarser =
      std::max(model.Scale(a.frame, a.keypoint), model.Scale(b.frame, b.keypoint));
  if (RayAngle(ray_a, ray_b) < min_parallax * coarser) return std::nullopt;
  const auto in_world = Triangulate(ray_a, ray_b);
  if (!in_world || !in_world->allFinite()) return std::nullopt;
  if (!FitsView(*in_world, a, model) || !FitsView(*in_world, b, model)) return std::nullopt;
  return in_world;
}

/// Returns whether a keypoint lies on a straight edge, along which its matches may slide. One whose
/// patch has been dropped is not known to.
bool IsOnEdge(const View& view) {
  constexpr double kMinEigenvalueShare = 0.04;
  const std::vector<orb::Patch>& patches = view.frame.patches;
  return !patches.empty() && orb::EigenvalueShare(patches[view.keypoint]) < kMinEigenvalueShare;
}

/// Returns whether too many keypoints of a frame lie on edges for the others to outvote them.
bool HasManyOnEdges(const Frame& frame) {
  constexpr double kMaxShareOnEdges = 0.3;  // Up to 0.26 outdoors and in furnished rooms.
  int num_on_edges = 0;
  for (int k = 0; k < frame.num_keypoints(); ++k) num_on_edges += IsOnEdge({frame, k});
  return num_on_edges > kMaxShareOnEdges * frame.num_keypoints();
}

/// Removes matches of keypoints on edges.
void RemoveOnEdges(const Frame& query, const Frame& train, std::vector<orb::Match>& matches) {
  std::erase_if(matches, [&](const orb::Match& match) {
    return IsOnEdge({query, match.query}) || IsOnEdge({train, match.train});
  });
}

/// Returns the depth below which no new landmark is expected.
double LeastDepth(std::vector<double> depths, const LandmarkOptions& options) {
  if (depths.empty()) return 0;
  const auto rank =
      static_cast<std::ptrdiff_t>(options.near_quantile * static_cast<double>(depths.size()));
  const auto near = std::min(depths.begin() + rank, depths.end() - 1);
  std::nth_element(depths.begin(), near, depths.end());
  return options.min_depth_share * *near;
}

/// Returns the most covisible keyframes whose baseline is long enough for their depth, the farthest
/// first: points that can be triangulated over a long baseline are not triangulated over a short
/// one.
std::vector<KeyframeId> FindNeighbors(const Map& map, KeyframeId keyframe,
                                      const LandmarkOptions& options) {
  std::vector<std::pair<double, KeyframeId>> by_distance;
  const Eigen::Vector3d& center = map.keyframe(keyframe).frame.world_from_camera.translation();
  for (const Covisible& covisible : map.FindCovisible(keyframe)) {
    if (static_cast<int>(by_distance.size()) == options.num_neighbors) break;
    const Frame& other = map.keyframe(covisible.keyframe).frame;
    const double baseline = (other.world_from_camera.translation() - center).norm();
    if (baseline < options.min_baseline_share * Median(DepthsOfLandmarks(map, other))) continue;
    by_distance.emplace_back(-baseline, covisible.keyframe);
  }
  std::sort(by_distance.begin(), by_distance.end());
  std::vector<KeyframeId> neighbors;
  for (const auto& [distance, id] : by_distance) neighbors.push_back(id);
  return neighbors;
}

/// Triangulates a match between two keyframes, adds the point as a landmark and triangulates it
/// again after aligning the second keypoint with the first. Returns whether a landmark was added.
bool CreateLandmark(const TrackElement& first, const TrackElement& second, double min_parallax,
                    Map& map) {
  const View a{map.keyframe(first.keyframe).frame, first.keypoint};
  const View b{map.keyframe(second.keyframe).frame, second.keypoint};
  const auto in_world = TriangulateViews(a, b, map.model(), min_parallax);
  if (!in_world) return false;
  const LandmarkId id = map.AddLandmark(*in_world, {first, second});
  map.UpdateAppearance(id);
  if (!AlignTrackElement(id, second, map)) return true;
  const auto refined = TriangulateViews(a, b, map.model(), min_parallax);
  if (refined) map.SetPosition(id, *refined);
  return true;
}

}  // namespace

int CreateLandmarks(KeyframeId keyframe, const LandmarkOptions& options, int max_distance,
                    Map& map) {
  const double min_parallax = options.min_parallax_deg * std::numbers::pi / 180;
  const Frame& frame = map.keyframe(keyframe).frame;
  const EpipolarMatchingOptions matching{LeastDepth(DepthsOfLandmarks(map, frame), options),
                                         max_distance, options.max_ratio, options.octave_tolerance,
                                         options.parallel_sigmas};
  const bool has_many_on_edges = HasManyOnEdges(frame);
  int num_created = 0;
  for (const KeyframeId neighbor : FindNeighbors(map, keyframe, options)) {
    map.UpdateRays(neighbor);
    const Frame& other = map.keyframe(neighbor).frame;
    std::vector<orb::Match> matches = MatchAlongEpipolarLines(frame, other, map.model(), matching);
    if (has_many_on_edges) RemoveOnEdges(frame, other, matches);
    for (const orb::Match& match : matches) {
      num_created +=
          CreateLandmark({keyframe, match.query}, {neighbor, match.train}, min_parallax, map);
    }
  }
  return num_created;
}

}  // namespace corvo
