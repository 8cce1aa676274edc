#include "vo/mapping/landmark_creation.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "vo/geometry/triangulation.h"
#include "vo/map/landmark_alignment.h"
#include "vo/mapping/epipolar_matching.h"
#include "vo/math/chi_square.h"
#include "vo/math/median.h"
#include "vo/optimization/pose_optimizer.h"

namespace corvo {
namespace {

/// One view of a point to be.
struct View {
  const Frame& frame;
  int keypoint;

  double OctaveScale(const KeypointNoise& noise) const {
    return noise.octave_scales[frame.keypoint(keypoint).octave];
  }
};

bool FitsView(const Eigen::Vector3d& in_world, const View& view, const Camera& camera,
              const KeypointNoise& noise) {
  const PointObservation observation{in_world, view.frame.pixel(view.keypoint),
                                     noise.Sigma(view.frame, view.keypoint)};
  return SquaredError(observation, view.frame.world_from_camera.Inverse(), camera) <=
         kChiSquare2Dof95;
}

std::optional<Eigen::Vector3d> TriangulateViews(const View& a, const View& b, const Camera& camera,
                                                const KeypointNoise& noise, double min_parallax) {
  const PosedRay ray_a{a.frame.world_from_camera, a.frame.rays[a.keypoint]};
  const PosedRay ray_b{b.frame.world_from_camera, b.frame.rays[b.keypoint]};
  const double coarser = std::max(a.OctaveScale(noise), b.OctaveScale(noise));
  if (RayAngle(ray_a, ray_b) < min_parallax * coarser) return std::nullopt;
  const auto in_world = Triangulate(ray_a, ray_b);
  if (!in_world || !in_world->allFinite()) return std::nullopt;
  if (!FitsView(*in_world, a, camera, noise) || !FitsView(*in_world, b, camera, noise)) {
    return std::nullopt;
  }
  return in_world;
}

/// Of the landmarks that a frame sees.
std::vector<double> Depths(const Map& map, const Frame& frame) {
  const SE3 camera_from_world = frame.world_from_camera.Inverse();
  std::vector<double> depths;
  for (const LandmarkId id : frame.landmarks) {
    if (id != kNoId) depths.push_back((camera_from_world * map.FindLandmark(id)->in_world).z());
  }
  return depths;
}

/// No new landmark is expected nearer: a third of the depth of the nearest known ones.
double LeastDepth(std::vector<double> depths) {
  if (depths.empty()) return 0;
  const auto near = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 20);
  std::nth_element(depths.begin(), near, depths.end());
  return *near / 3;
}

/// The most covisible keyframes that stand far enough away for their depth, the farthest first:
/// what can be triangulated over a long baseline is not triangulated over a short one.
std::vector<KeyframeId> FindNeighbors(const Map& map, KeyframeId keyframe, int max_neighbors) {
  constexpr double kMinBaselineShare = 0.01;
  std::vector<std::pair<double, KeyframeId>> by_distance;
  const Eigen::Vector3d& centre = map.keyframe(keyframe).frame.world_from_camera.translation();
  for (const Covisible& covisible : map.FindCovisible(keyframe)) {
    if (static_cast<int>(by_distance.size()) == max_neighbors) break;
    const Frame& other = map.keyframe(covisible.keyframe).frame;
    const double baseline = (other.world_from_camera.translation() - centre).norm();
    if (baseline < kMinBaselineShare * Median(Depths(map, other))) continue;
    by_distance.emplace_back(-baseline, covisible.keyframe);
  }
  std::sort(by_distance.begin(), by_distance.end());
  std::vector<KeyframeId> neighbors;
  for (const auto& [distance, id] : by_distance) neighbors.push_back(id);
  return neighbors;
}

}  // namespace

int CreateLandmarks(Map& map, KeyframeId keyframe, const Camera& camera, const KeypointNoise& noise,
                    const KeyframeOptions& options) {
  const double min_parallax = options.min_parallax_deg * std::numbers::pi / 180;
  const double min_depth = LeastDepth(Depths(map, map.keyframe(keyframe).frame));
  int num_created = 0;
  for (const KeyframeId neighbor : FindNeighbors(map, keyframe, options.num_neighbors)) {
    map.UpdateRays(camera, neighbor);
    const Frame& first = map.keyframe(keyframe).frame;
    const Frame& second = map.keyframe(neighbor).frame;
    for (const orb::Match& match :
         MatchAlongEpipolarLines(first, second, camera, noise, min_depth, options.max_distance)) {
      const auto in_world = TriangulateViews({first, match.query}, {second, match.train}, camera,
                                             noise, min_parallax);
      if (!in_world) continue;
      const LandmarkId id =
          map.AddLandmark(*in_world, {{keyframe, match.query}, {neighbor, match.train}});
      map.UpdateAppearance(id, noise.octave_scales);
      if (AlignObservation(id, {neighbor, match.train}, camera, noise.octave_scales, map)) {
        const auto refined = TriangulateViews({first, match.query}, {second, match.train}, camera,
                                              noise, min_parallax);
        if (refined) map.SetPosition(id, *refined);
      }
      ++num_created;
    }
  }
  return num_created;
}

}  // namespace corvo
