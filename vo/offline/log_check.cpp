// SPDX-License-Identifier: MIT
#include "vo/offline/log_check.h"

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "orb/error.h"

namespace corvo {
namespace {

/// Throws corvo::Error unless 0 <= id < count.
void CheckId(const std::string& name, int id, int count) {
  if (count == 0) throw Error(name + " is " + std::to_string(id) + "; there are none");
  CheckRange(name, id, 0, count - 1);
}

/// Checks the reports of a log one by one, and collects how many of their observations lie on a
/// keypoint of an active keyframe.
class LogCheck {
 public:
  LogCheck(const Odometry& odometry, const Trajectory& trajectory)
      : map_(odometry.map()), trajectory_(trajectory) {
    for (const KeyframeId id : map_.ActiveKeyframes()) {
      const Frame& frame = map_.keyframe(id).frame;
      for (const Eigen::Vector2d& pixel : frame.pixels) AddPixel(frame.index, pixel);
    }
  }

  void Add(const FrameObservations& seen) {
    CheckId("observations: frame", seen.frame, static_cast<int>(trajectory_.frames.size()));
    // The odometry may have discarded the pose of the frame, and the map that it refers to.
    if (!trajectory_.frames[seen.frame].world_from_camera) return;
    const std::string where = "observations of frame " + std::to_string(seen.frame) + ": ";
    if (seen.keyframe != kNoId) CheckId(where + "keyframe", seen.keyframe, map_.num_keyframes());
    const std::size_t num_positions = seen.keyframe == kNoId ? 0 : seen.observations.size();
    CheckRange(where + "number of positions", seen.in_world.size(), num_positions, num_positions);
    for (const Eigen::Vector3d& point : seen.in_world) {
      if ((point.cwiseAbs().array() <= kMaxCoordinate).all()) continue;
      throw Error(where + "a position is not finite or too far away");
    }
    for (const LandmarkMerge& merge : seen.merges) CheckMerge(where, merge);
    for (const Observation& observation : seen.observations) {
      CheckObservation(where, observation);
      if (seen.keyframe == kNoId) CountPixel(seen.frame, observation.pixel);
    }
  }

  /// Throws corvo::Error if fewer than half of the observations lie on keypoints.
  void CheckKeyframes() const {
    if (pixels_.empty() || 2 * num_found_ >= std::max(1, num_counted_)) return;
    throw Error("the observations are not those of this odometry: " + std::to_string(num_found_) +
                " of " + std::to_string(num_counted_) +
                " in its active keyframes lie on a keypoint; record it from its first image on");
  }

 private:
  /// Logs hold pixels in single precision.
  static std::pair<float, float> KeyOf(const Eigen::Vector2d& pixel) {
    return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
  }

  void AddPixel(int frame, const Eigen::Vector2d& pixel) { pixels_[frame].insert(KeyOf(pixel)); }

  void CountPixel(int frame, const Eigen::Vector2d& pixel) {
    const auto keyframe = pixels_.find(frame);
    if (keyframe == pixels_.end()) return;
    ++num_counted_;
    num_found_ += static_cast<int>(keyframe->second.count(KeyOf(pixel)));
  }

  void CheckMerge(const std::string& where, const LandmarkMerge& merge) {
    CheckId(where + "merged landmark", merge.from, map_.num_landmark_ids());
    CheckId(where + "landmark of a merge", merge.into, map_.num_landmark_ids());
    LandmarkId into = merge.into;
    for (auto next = merged_.find(into); next != merged_.end(); next = merged_.find(into)) {
      into = next->second;
    }
    if (into == merge.from) throw Error(where + "a landmark is merged into itself");
    merged_[merge.from] = merge.into;
  }

  void CheckObservation(const std::string& where, const Observation& observation) const {
    CheckId(where + "landmark", observation.landmark, map_.num_landmark_ids());
    if (!map_.camera().Contains(observation.pixel))
      throw Error(where + "a pixel is not in the image");
    CheckPositive(where + "sigma_px", observation.sigma_px);
  }

  const Map& map_;
  const Trajectory& trajectory_;
  std::map<int, std::set<std::pair<float, float>>> pixels_;  ///< Keypoints of active keyframes.
  std::map<LandmarkId, LandmarkId> merged_;
  int num_counted_ = 0, num_found_ = 0;
};

}  // namespace

void CheckLog(const Odometry& odometry, const Trajectory& trajectory, const ObservationLog& log) {
  LogCheck check(odometry, trajectory);
  log.Visit([&](const FrameObservations& seen) { check.Add(seen); });
  check.CheckKeyframes();
}

}  // namespace corvo
