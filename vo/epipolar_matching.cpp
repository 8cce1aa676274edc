#include "vo/epipolar_matching.h"

#include <cmath>

#include "orb/hamming.h"
#include "vo/chi_square.h"
#include "vo/lie/so3.h"

namespace corvo {
namespace {

/// The keypoints of a frame that see no landmark, with what the inner loop reads.
struct FreeKeypoints {
  std::vector<int> index;
  std::vector<Eigen::Vector2d> rays;
  std::vector<double> max_squared_distance;  ///< From an epipolar line, squared ray units.
};

FreeKeypoints CollectFree(const Frame& frame, const Camera& camera, const KeypointNoise& noise) {
  FreeKeypoints free;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] != kNoId) continue;
    const double sigma = noise.Sigma(frame.keypoint(k)) / camera.FocalAt(frame.rays[k]);
    free.index.push_back(k);
    free.rays.push_back(frame.rays[k]);
    free.max_squared_distance.push_back(kChiSquare1Dof95 * sigma * sigma);
  }
  return free;
}

/// The nearest and second nearest descriptors among the keypoints near a line.
orb::Nearest FindNearestOnLine(const orb::Descriptor& query, const Eigen::Vector3d& line,
                               const FreeKeypoints& candidates, const Frame& frame) {
  orb::Nearest nearest;
  const double squared_norm = line.head<2>().squaredNorm();
  for (std::size_t c = 0; c < candidates.index.size(); ++c) {
    const Eigen::Vector2d& ray = candidates.rays[c];
    const double distance = line.x() * ray.x() + line.y() * ray.y() + line.z();
    if (distance * distance > candidates.max_squared_distance[c] * squared_norm) continue;
    const int bits = orb::HammingDistance(query, frame.descriptor(candidates.index[c]));
    if (bits < nearest.distance) {
      nearest.second_distance = nearest.distance;
      nearest.second_index = nearest.index;
      nearest.distance = bits;
      nearest.index = candidates.index[c];
    } else if (bits < nearest.second_distance) {
      nearest.second_distance = bits;
      nearest.second_index = candidates.index[c];
    }
  }
  return nearest;
}

}  // namespace

std::vector<orb::Match> MatchAlongEpipolarLines(const Frame& first, const Frame& second,
                                                const Camera& camera, const KeypointNoise& noise,
                                                int max_distance) {
  constexpr double kMaxRatio = 0.9;
  const SE3 second_from_first = second.world_from_camera.Inverse() * first.world_from_camera;
  const Eigen::Matrix3d essential =
      SO3::Hat(second_from_first.translation()) * second_from_first.rotation().matrix();
  const FreeKeypoints free_first = CollectFree(first, camera, noise);
  const FreeKeypoints free_second = CollectFree(second, camera, noise);
  std::vector<orb::Match> matches;
  for (std::size_t i = 0; i < free_first.index.size(); ++i) {
    const int k = free_first.index[i];
    const Eigen::Vector3d line = essential * free_first.rays[i].homogeneous();
    const orb::Nearest nearest = FindNearestOnLine(first.descriptor(k), line, free_second, second);
    if (nearest.distance > max_distance) continue;
    if (nearest.distance > kMaxRatio * nearest.second_distance) continue;
    matches.push_back({k, nearest.index, nearest.distance});
  }
  return orb::KeepConsistentRotation(orb::KeepUnique(matches), first.features.keypoints,
                                     second.features.keypoints);
}

}  // namespace corvo
