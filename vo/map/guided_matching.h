// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "orb/matcher.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// Descriptors to search for in a frame, and a search window for each.
struct GuidedQueries {
  std::vector<int> ids;  ///< Landmark or keypoint of each query, as defined by the caller.
  std::vector<orb::Descriptor> descriptors;
  std::vector<Eigen::Vector2d> pixels;  ///< Predicted position of each query.
  std::vector<orb::SearchWindow> windows;
  std::vector<orb::Keypoint> keypoints;  ///< Earlier keypoint of each query; empty for landmarks.

  int size() const { return static_cast<int>(ids.size()); }
};

/// The predicted position of a keypoint of one frame in another.
struct PredictedKeypoint {
  int id = kNoId;  ///< Id of its query.
  int keypoint = kNoId;
  Eigen::Vector2d pixel;
};

/// Returns queries for keypoints of a frame, with a search radius of `radius_px` pixels of the
/// keypoint's octave and windows that extend one octave up and down. Predictions outside the image
/// are skipped.
GuidedQueries QueryKeypoints(const Frame& frame, const std::vector<PredictedKeypoint>& predictions,
                             double radius_px, const MeasurementModel& model);

/// The search window around the projection of a landmark. Radii are in pixels of the predicted
/// octave.
struct LandmarkWindow {
  double frontal_radius_px = 3;  ///< Radius for a frontal view.
  double oblique_radius_px = 3;  ///< Radius for any other view.
  double max_frontal_angle_deg = 0;
  int octaves_below = 1;
  int octaves_above = 0;
};

/// Returns queries for the landmarks that should be visible from a pose, see ProjectLandmark.
GuidedQueries ProjectLandmarks(const Map& map, const std::vector<LandmarkId>& landmarks,
                               const SE3& world_from_camera, const LandmarkWindow& window);

/// The second nearest descriptor with which the ratio test compares a match.
enum class RatioTest {
  kNone,
  kAnyOctave,
  /// Ignores a second nearest in another octave, which is the same corner at another scale.
  kSameOctave,
};

/// The conditions that a guided match must satisfy.
struct GuidedMatchingOptions {
  int max_distance = 256;  ///< Largest descriptor distance, bits.
  RatioTest ratio_test = RatioTest::kNone;
  double max_ratio = 1;
};

/// Returns for each query the nearest keypoint of the frame inside its window if it passes the
/// distance and ratio tests. Each keypoint is matched at most once, and matches of queries with
/// keypoints must have consistent rotations. `query` is an index in `queries`, `train` a keypoint
/// of the frame.
std::vector<orb::Match> MatchGuided(const GuidedQueries& queries, const Frame& frame,
                                    const GuidedMatchingOptions& options);

}  // namespace corvo
