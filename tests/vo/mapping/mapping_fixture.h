// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/point_scene.h"
#include "vo/core/options.h"

namespace corvo::test {

/// A scene of points and a map of views of it; some points are landmarks of the map.
class MappingTest : public ::testing::Test {
 protected:
  static constexpr int kMaxDistance = 65;

  /// Adds views `step_` apart along x; only the first `num_known` points of the scene become
  /// landmarks.
  void MakeViews(int num_views, int num_known) {
    for (int i = 0; i < num_views; ++i) {
      const SE3 pose(SO3(), Eigen::Vector3d(step_ * i, 0, 0));
      views_.push_back(ObserveScene(scene_, camera_, pose, 0.2, random_));
      map_.AddKeyframe(views_.back().frame, 0);
    }
    for (int point = 0; point < num_known; ++point) {
      std::vector<TrackElement> observations = ObservationsOf(point);
      if (observations.size() < 2) continue;
      const LandmarkId id = map_.AddLandmark(scene_.in_world[point], observations);
      map_.UpdateAppearance(id);
    }
  }

  std::vector<TrackElement> ObservationsOf(int point) const {
    std::vector<TrackElement> observations;
    for (int v = 0; v < static_cast<int>(views_.size()); ++v) {
      for (int k = 0; k < static_cast<int>(views_[v].points.size()); ++k) {
        if (views_[v].points[k] == point) observations.push_back({v, k});
      }
    }
    return observations;
  }

  int PointOf(const TrackElement& o) const { return views_[o.keyframe].points[o.keypoint]; }

  double step_ = 0.4;
  Random random_{1};
  Camera camera_ = PinholeCamera();
  LandmarkOptions options_;
  PointScene scene_ = MakeBoxScene(400, 3, 10, random_);
  std::vector<SceneView> views_;
  Map map_{test::MakeModel()};
};

}  // namespace corvo::test
