#include "vo/epipolar_matching.h"

#include <cmath>

#include "orb/kernels/line_search.h"
#include "vo/chi_square.h"
#include "vo/lie/so3.h"

namespace corvo {
namespace {

/// The keypoints of a frame that see no landmark, with what the inner loops read.
struct FreeKeypoints {
  std::vector<int> index;
  std::vector<orb::Descriptor> descriptors;
  std::vector<double> x;  ///< Of the rays.
  std::vector<double> y;
  std::vector<double> max_squared_distances;  ///< From an epipolar line, squared ray units.
};

FreeKeypoints CollectFree(const Frame& frame, const Camera& camera, const KeypointNoise& noise) {
  FreeKeypoints free;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] != kNoId) continue;
    const double sigma = noise.Sigma(frame.keypoint(k)) / camera.FocalAt(frame.rays[k]);
    free.index.push_back(k);
    free.descriptors.push_back(frame.descriptor(k));
    free.x.push_back(frame.rays[k].x());
    free.y.push_back(frame.rays[k].y());
    free.max_squared_distances.push_back(kChiSquare1Dof95 * sigma * sigma);
  }
  return free;
}

/// Finds among keypoints those near a line that have the nearest descriptors.
class LineMatcher {
 public:
  explicit LineMatcher(const FreeKeypoints& candidates)
      : candidates_(candidates), near_line_(candidates.index.size()) {}

  /// The nearest and second nearest descriptor; indices are among the candidates.
  orb::Nearest FindNearest(const orb::Descriptor& query, const Eigen::Vector3d& line) {
    const int num_near = orb::kernels::FindNearLine(
        {candidates_.x.data(), candidates_.y.data(), candidates_.max_squared_distances.data(),
         static_cast<int>(candidates_.index.size())},
        {line.x(), line.y(), line.z()}, near_line_.data());
    return orb::FindNearestAmong(query, candidates_.descriptors,
                                 {near_line_.data(), static_cast<std::size_t>(num_near)});
  }

 private:
  const FreeKeypoints& candidates_;
  std::vector<int> near_line_;
};

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
  LineMatcher matcher(free_second);
  std::vector<orb::Match> matches;
  for (std::size_t i = 0; i < free_first.index.size(); ++i) {
    const Eigen::Vector3d line = essential * Eigen::Vector3d(free_first.x[i], free_first.y[i], 1);
    const orb::Nearest nearest = matcher.FindNearest(free_first.descriptors[i], line);
    if (nearest.distance > max_distance) continue;
    if (nearest.distance > kMaxRatio * nearest.second_distance) continue;
    matches.push_back({free_first.index[i], free_second.index[nearest.index], nearest.distance});
  }
  return orb::KeepConsistentRotation(orb::KeepUnique(matches), first.features.keypoints,
                                     second.features.keypoints);
}

}  // namespace corvo
