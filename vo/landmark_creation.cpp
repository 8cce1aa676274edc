#include "vo/landmark_creation.h"

#include <numbers>
#include <vector>

#include "vo/chi_square.h"
#include "vo/epipolar_matching.h"
#include "vo/pose_optimizer.h"
#include "vo/triangulation.h"

namespace corvo {
namespace {

/// One view of a point to be.
struct View {
  const Frame& frame;
  int keypoint;

  double Distance(const Eigen::Vector3d& in_world) const {
    return (in_world - frame.world_from_camera.translation()).norm();
  }
};

bool FitsView(const Eigen::Vector3d& in_world, const View& view, const Camera& camera,
              const KeypointNoise& noise) {
  const PointObservation observation{in_world, view.frame.pixel(view.keypoint),
                                     noise.Sigma(view.frame.keypoint(view.keypoint))};
  return SquaredError(observation, view.frame.world_from_camera.Inverse(), camera) <=
         kChiSquare2Dof95;
}

/// The nearer view should see the point in the coarser octave.
bool OctavesAgree(const Eigen::Vector3d& in_world, const View& a, const View& b,
                  const std::vector<double>& octave_scales) {
  constexpr double kTolerance = 1.5;
  const double by_distance = a.Distance(in_world) / b.Distance(in_world);
  const double by_octave = octave_scales[b.frame.keypoint(b.keypoint).octave] /
                           octave_scales[a.frame.keypoint(a.keypoint).octave];
  const double tolerance = kTolerance * octave_scales[octave_scales.size() > 1 ? 1 : 0];
  return by_distance < by_octave * tolerance && by_octave < by_distance * tolerance;
}

std::optional<Eigen::Vector3d> TriangulateViews(const View& a, const View& b, const Camera& camera,
                                                const KeypointNoise& noise, double min_parallax) {
  const auto in_world = Triangulate({a.frame.world_from_camera, a.frame.rays[a.keypoint]},
                                    {b.frame.world_from_camera, b.frame.rays[b.keypoint]});
  if (!in_world || !in_world->allFinite()) return std::nullopt;
  if (ParallaxAngle(*in_world, a.frame.world_from_camera, b.frame.world_from_camera) <
      min_parallax) {
    return std::nullopt;
  }
  if (!FitsView(*in_world, a, camera, noise) || !FitsView(*in_world, b, camera, noise)) {
    return std::nullopt;
  }
  if (!OctavesAgree(*in_world, a, b, noise.octave_scales)) return std::nullopt;
  return in_world;
}

}  // namespace

int CreateLandmarks(Map& map, KeyframeId keyframe, const Camera& camera, const KeypointNoise& noise,
                    const KeyframeOptions& options) {
  const double min_parallax = options.min_parallax_deg * std::numbers::pi / 180;
  std::vector<Covisible> neighbors = map.FindCovisible(keyframe);
  if (static_cast<int>(neighbors.size()) > options.num_neighbors) {
    neighbors.resize(options.num_neighbors);
  }
  int num_created = 0;
  for (const Covisible& neighbor : neighbors) {
    const Frame& first = map.keyframe(keyframe).frame;
    const Frame& second = map.keyframe(neighbor.keyframe).frame;
    for (const orb::Match& match :
         MatchAlongEpipolarLines(first, second, camera.focal(), noise, options.max_distance)) {
      const auto in_world = TriangulateViews({first, match.query}, {second, match.train}, camera,
                                             noise, min_parallax);
      if (!in_world) continue;
      const LandmarkId id =
          map.AddLandmark(*in_world, {{keyframe, match.query}, {neighbor.keyframe, match.train}});
      map.UpdateAppearance(id, noise.octave_scales);
      ++num_created;
    }
  }
  return num_created;
}

}  // namespace corvo
