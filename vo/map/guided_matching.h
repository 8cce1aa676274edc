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

/// Descriptors to find in a frame, and the window in which to look for each.
struct GuidedQueries {
  std::vector<int> ids;  ///< What each stands for: a landmark or a keypoint, as the caller says.
  std::vector<orb::Descriptor> descriptors;
  std::vector<Eigen::Vector2d> pixels;  ///< Where each is predicted.
  std::vector<orb::SearchWindow> windows;
  std::vector<orb::Keypoint> keypoints;  ///< As each was seen before; empty for landmarks.

  int size() const { return static_cast<int>(ids.size()); }
};

/// Where a keypoint of one frame is predicted in another.
struct PredictedKeypoint {
  int id = kNoId;  ///< Of its query.
  int keypoint = kNoId;
  Eigen::Vector2d pixel;
};

/// Queries for keypoints of a frame, each within `radius_px` pixels of its octave, and one octave
/// up or down. Predictions outside the image are left out.
GuidedQueries QueryKeypoints(const Frame& frame, const std::vector<PredictedKeypoint>& predictions,
                             double radius_px, const MeasurementModel& model);

/// Where a landmark is searched for around its projection.
struct LandmarkWindow {
  double frontal_radius_px = 3;  ///< Of its predicted octave, where it is seen frontally.
  double oblique_radius_px = 3;  ///< Elsewhere.
  double max_frontal_angle_deg = 0;
  int octaves_below = 1;
  int octaves_above = 0;
};

/// Queries for the landmarks that should be visible from a pose, see ProjectLandmark.
GuidedQueries ProjectLandmarks(const Map& map, const std::vector<LandmarkId>& landmarks,
                               const SE3& world_from_camera, const LandmarkWindow& window);

/// Which second nearest descriptor a match must be clearly nearer than.
enum class RatioTest {
  kNone,
  kAnyOctave,
  /// A second nearest in another octave is the same corner seen coarser or finer: it is ignored.
  kSameOctave,
};

/// What a guided match must satisfy.
struct GuidedMatchingOptions {
  int max_distance = 256;  ///< Bits.
  RatioTest ratio_test = RatioTest::kNone;
  double max_ratio = 1;
};

/// The nearest keypoint of a frame for each query inside its window, if it is near enough and
/// distinct; each keypoint is matched at most once, and queries that have keypoints must turn
/// consistently. `query` is an index in `queries`, `train` a keypoint of the frame.
std::vector<orb::Match> MatchGuided(const GuidedQueries& queries, const Frame& frame,
                                    const GuidedMatchingOptions& options);

}  // namespace corvo
