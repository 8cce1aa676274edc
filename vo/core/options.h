// SPDX-License-Identifier: MIT
#pragma once

#include "orb/options.h"

namespace corvo {

// Options structs are the manual: `Visit` and `VisitAdvanced` name each field once, with its range
// and its meaning. The fields of `Visit` are the keys of configuration files; those of
// `VisitAdvanced` are for users of the library. Validation covers both. The arguments are those of
// orb::ExtractorOptions::Visit.
//
// A comment beside each value states its source: a paper, or this project's own measurements in
// docs/ablation.md ("ablation").

/// Descriptor distances up to which two keypoints may match. The defaults suit the learned binary
/// tests; for `extractor.pattern: brief` use 80 and 50.
struct MatchingOptions {
  int max_tracking_distance = 95;  // ablation
  int max_distance = 65;           // ablation

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("max_tracking_distance", self.max_tracking_distance, 1, 256,
          "largest descriptor distance of a match near a predicted position, bits");
    field("max_distance", self.max_distance, 1, 256,
          "largest descriptor distance of any other match, bits");
  }
};

/// The precision of image measurements, and the conditions under which a landmark is visible.
struct MeasurementOptions {
  double keypoint_sigma_px = 1.0;    // ablation
  double aligned_sigma_px = 0.6;     // ablation
  double min_view_cosine = 0.5;      // Mur-Artal et al., "ORB-SLAM", 2015, V-D.
  double distance_tolerance = 1.25;  // ablation
  double min_correlation = 0.8;      // ablation
  double sigma_along_ray = 10;       // Any value far above 1 means "unknown".

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("keypoint_sigma_px", self.keypoint_sigma_px, 0.01, 100.0,
          "standard deviation of a detected keypoint, px of its own pyramid level");
    field(
        "aligned_sigma_px", self.aligned_sigma_px, 0.01, 100.0,
        "standard deviation of a keypoint aligned with its landmark's patch, px of its own level");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_view_cosine", self.min_view_cosine, -1.0, 1.0,
          "cosine of the largest angle to a landmark's mean viewing direction from which it is "
          "visible");
    field("distance_tolerance", self.distance_tolerance, 1.0, 100.0,
          "factor by which a landmark may be nearer or farther than its octaves can show");
    field("min_correlation", self.min_correlation, 0.0, 1.0,
          "least correlation of two aligned patches");
    field("sigma_along_ray", self.sigma_along_ray, 1.0, 1e6,
          "standard deviation of a point along a single ray, in units of its distance");
  }
};

/// Options of two-view initialization.
struct InitializerOptions {
  int min_matches = 100;                  // Mur-Artal et al., 2015, IV.
  double min_parallax_deg = 1.0;          // Mur-Artal et al., 2015, IV.
  int max_waiting_frames = 100;           // Bounds memory.
  double min_parallax_sigmas = 3.0;       // Three standard deviations.
  double max_homography_share = 0.45;     // Mur-Artal et al., 2015, eq. (3).
  int min_points = 50;                    // Mur-Artal et al., 2015, IV.
  double max_ratio = 0.8;                 // Lowe, "Distinctive image features", 2004, 7.1.
  double max_second_motion_share = 0.7;   // ablation
  double min_share_in_front = 0.9;        // ablation
  int min_rotation_matches = 30;          // ablation
  double rotation_search_radius_px = 10;  // ablation
  int min_refinement_matches = 10;        // ablation
  double max_plane_change_deg = 15;       // ablation
  double min_share_before_plane = 0.98;   // ablation
  double common_parallax = 4;             // ablation

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("min_matches", self.min_matches, 20, 100000,
          "least number of matches between the two views");
    field("min_parallax_deg", self.min_parallax_deg, 0.0, 90.0,
          "parallax that enough points of the first map must reach, degrees");
    field("max_waiting_frames", self.max_waiting_frames, 2, 10000,
          "frames kept until initialization succeeds; they get poses afterwards");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_parallax_sigmas", self.min_parallax_sigmas, 0.0, 1000.0,
          "median parallax below which the motion is a rotation, in keypoint standard deviations");
    field("max_homography_share", self.max_homography_share, 0.0, 1.0,
          "share of the homography in the two models' scores above which the scene is planar");
    field("min_points", self.min_points, 10, 100000, "least number of points of the first map");
    field("max_ratio", self.max_ratio, 0.1, 1.0,
          "distance of the nearest descriptor over that of the second nearest");
    field("max_second_motion_share", self.max_second_motion_share, 0.0, 1.0,
          "points in front under the second best motion, as a share of those under the best");
    field("min_share_in_front", self.min_share_in_front, 0.0, 1.0,
          "share of the inliers, points that may be at infinity apart, that must be in front of "
          "both views");
    field("min_rotation_matches", self.min_rotation_matches, 3, 100000,
          "least number of matches to tell a rotation");
    field("rotation_search_radius_px", self.rotation_search_radius_px, 1.0, 500.0,
          "search radius around a keypoint predicted by a rotation, px of its level");
    field("min_refinement_matches", self.min_refinement_matches, 3, 100000,
          "least number of matches to refine a rotation");
    field("max_plane_change_deg", self.max_plane_change_deg, 0.0, 90.0,
          "angle between normals that belong to the same plane, degrees");
    field("min_share_before_plane", self.min_share_before_plane, 0.0, 1.0,
          "inliers whose rays must meet the plane in front of the camera");
    field(
        "common_parallax", self.common_parallax, 0.0, 1e6,
        "standard deviation of a coarse rotation, as a multiple of the median parallax it leaves");
  }
};

/// Options of the pose optimization of one frame from its landmarks.
struct PoseOptimizerOptions {
  int num_rounds = 4;         // ablation
  int num_robust_rounds = 2;  // ablation
  int max_iterations = 10;    // ablation

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("num_rounds", self.num_rounds, 1, 100, "rounds, each of which classifies inliers anew");
    field("num_robust_rounds", self.num_robust_rounds, 0, 100,
          "first rounds that use Huber's loss");
    field("max_iterations", self.max_iterations, 1, 1000, "iterations of one round");
  }
};

/// Options for locating a frame in the map.
struct TrackerOptions {
  double search_radius_px = 15;        // ablation
  int min_inliers = 20;                // ablation
  int min_matches = 20;                // ablation
  int min_first_inliers = 10;          // ablation
  double widening = 2;                 // ablation
  double min_inlier_share = 0.5;       // ablation
  int max_local_keyframes = 30;        // ablation
  double max_ratio = 0.8;              // Lowe, 2004, 7.1.
  double max_frontal_angle_deg = 3.6;  // ablation
  double frontal_radius_px = 2.5;      // ablation
  double oblique_radius_px = 4.0;      // ablation
  double pnp_max_error_sigmas = 3;     // Three standard deviations.
  int pnp_max_iterations = 300;        // Enough for 40% inliers at a confidence of 0.999.

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("search_radius_px", self.search_radius_px, 1.0, 500.0,
          "search radius around the predicted position of a landmark of the previous frame, px of "
          "its level");
    field("min_inliers", self.min_inliers, 15, 10000,
          "least number of landmarks that must agree with the pose");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_matches", self.min_matches, 6, 10000,
          "least number of matches with the previous frame; with fewer the search is widened");
    field("min_first_inliers", self.min_first_inliers, 6, 10000,
          "least number of inliers among the matches with the previous frame");
    field("widening", self.widening, 1.0, 10.0, "factor of the second, wider search radius");
    field("min_inlier_share", self.min_inlier_share, 0.0, 1.0,
          "share of inliers below which the wider search is tried, too");
    field("max_local_keyframes", self.max_local_keyframes, 1, 1000,
          "covisible keyframes whose landmarks are searched for");
    field("max_ratio", self.max_ratio, 0.1, 1.0,
          "distance of the nearest descriptor over that of the second nearest in its octave");
    field("max_frontal_angle_deg", self.max_frontal_angle_deg, 0.0, 180.0,
          "angle to the mean viewing direction up to which a view is frontal, degrees");
    field("frontal_radius_px", self.frontal_radius_px, 0.1, 500.0,
          "search radius around a landmark seen frontally, px of its level");
    field("oblique_radius_px", self.oblique_radius_px, 0.1, 500.0,
          "search radius around any other landmark, px of its level");
    field("pnp_max_error_sigmas", self.pnp_max_error_sigmas, 0.1, 100.0,
          "inlier threshold of the perspective-n-point search, in keypoint standard deviations");
    field("pnp_max_iterations", self.pnp_max_iterations, 1, 1000000,
          "iterations of the perspective-n-point search");
  }
};

/// Options of relocalization after tracking was lost.
struct RelocalizerOptions {
  int max_keyframes = 200;  // Bounds memory.
  double max_lost_s = 1.0;  // ablation
  int max_candidates = 5;   // ablation
  int min_inliers = 25;     // ablation

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("max_keyframes", self.max_keyframes, 1, 100000,
          "newest active keyframes of the segment in which a lost frame is searched for");
    field("max_lost_s", self.max_lost_s, 0.0, 1e6,
          "time since the last pose after which a new segment may start, s");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("max_candidates", self.max_candidates, 1, 1000,
          "most similar keyframes from which the frame is tracked");
    field("min_inliers", self.min_inliers, 15, 10000,
          "least number of landmarks that must agree with the pose");
  }
};

/// Options for guessing the scale of a segment that starts after a loss.
struct SegmentStartOptions {
  double speed_window_s = 1.0;        // Long enough for a median, short enough for one motion.
  int min_speeds = 5;                 // The spread of fewer values is hardly known.
  double unknown_speed_spread = 0.3;  // docs/development/ablation.md
  double speed_growth = 0.25;         // docs/development/ablation.md

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("speed_window_s", self.speed_window_s, 1e-3, 1e6,
          "time before the loss whose median speed sets the scale of a new segment, s");
    field("min_speeds", self.min_speeds, 1, 100000,
          "number of speeds from which their spread is taken as it is");
    field("unknown_speed_spread", self.unknown_speed_spread, 0.0, 10.0,
          "least standard deviation of the logarithm of the speed if there are fewer speeds");
    field("speed_growth", self.speed_growth, 0.0, 10.0,
          "standard deviation by which the logarithm of a constant speed changes in a second");
  }
};

/// Options for joining two segments that have landmarks in common.
struct SegmentJoiningOptions {
  int min_common_landmarks = 20;        // As many as a pose requires.
  double max_depth_factor = 1.3;        // Far more than the noise of triangulated depths.
  double min_consistent_share = 0.8;    // One rigid scene, a few wrong matches.
  double max_scale_factor = 1.15;       // The spread of depths, averaged over the landmarks.
  double max_rotation_deg = 5.0;        // Far more than the noise of a pose.
  double max_translation_share = 0.15;  // As for the scale.

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_common_landmarks", self.min_common_landmarks, 3, 100000,
          "keypoints of a keyframe that must observe a landmark in both segments");
    field("max_depth_factor", self.max_depth_factor, 1.0, 100.0,
          "largest factor between a keypoint's ratio of depths and the median ratio");
    field("min_consistent_share", self.min_consistent_share, 0.5, 1.0,
          "least share of the common landmarks that are within that factor");
    field("max_scale_factor", self.max_scale_factor, 1.0, 100.0,
          "largest factor between the scales that two keyframes give");
    field("max_rotation_deg", self.max_rotation_deg, 0.0, 180.0,
          "largest angle between the rotations that two keyframes give, degrees");
    field(
        "max_translation_share", self.max_translation_share, 0.0, 100.0,
        "largest distance between the positions that two keyframes give, as a share of the depth");
  }
};

/// Options that decide when a frame becomes a keyframe.
struct KeyframeOptions {
  double max_tracked_share = 0.75;  // ablation
  double min_seeing_share = 0.07;   // ablation

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("max_tracked_share", self.max_tracked_share, 0.0, 1.0,
          "a keyframe is due when fewer of the nearest keyframe's landmarks are tracked");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_seeing_share", self.min_seeing_share, 0.0, 1.0,
          "a keyframe is due when fewer of the frame's keypoints observe landmarks");
  }
};

/// Options for creating and fusing landmarks around a new keyframe.
struct LandmarkOptions {
  int num_neighbors = 6;          // ablation
  double min_parallax_deg = 0.6;  // ablation
  double min_baseline_share =
      0.01;                     // Mur-Artal et al., 2015, VI-C (code of this project: ablation).
  double near_quantile = 0.05;  // ablation
  double min_depth_share = 1.0 / 3;  // ablation
  double max_ratio = 0.9;            // ablation
  double octave_tolerance = 1.5;     // ablation
  double parallel_sigmas = 3;        // Three standard deviations.
  double fusion_radius_px = 3;       // ablation
  int num_aligned_keyframes = 30;    // Bounds memory.

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("num_neighbors", self.num_neighbors, 1, 100,
          "covisible keyframes with which a new one is triangulated and fused");
    field("min_parallax_deg", self.min_parallax_deg, 0.0, 90.0,
          "least parallax of a new landmark, degrees times the scale of its coarser octave");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_baseline_share", self.min_baseline_share, 0.0, 1.0,
          "least baseline to a neighbor, as a share of its median depth");
    field("near_quantile", self.near_quantile, 0.0, 1.0,
          "quantile of the known depths that stands for the nearest of them");
    field("min_depth_share", self.min_depth_share, 0.0, 1.0,
          "least depth of a new landmark, as a share of that quantile");
    field(
        "max_ratio", self.max_ratio, 0.1, 1.0,
        "distance of the nearest descriptor over that of the second nearest near an epipolar line");
    field("octave_tolerance", self.octave_tolerance, 1.0, 100.0,
          "octaves by which the scales of a match may contradict its distances, as a factor");
    field("parallel_sigmas", self.parallel_sigmas, 0.0, 100.0,
          "angle up to which rays count as parallel, in keypoint standard deviations");
    field("fusion_radius_px", self.fusion_radius_px, 0.1, 500.0,
          "search radius around a landmark projected into a neighbor, px of its level");
    field("num_aligned_keyframes", self.num_aligned_keyframes, 1, 100000,
          "newest keyframes that keep their patches");
  }
};

/// Options that decide which landmarks and keyframes are removed.
struct CullingOptions {
  double min_found_share = 0.25;     // ablation
  int num_probation_keyframes = 3;   // ablation
  int min_observations = 3;          // ablation
  int min_observations_age = 2;      // ablation
  double max_redundant_share = 0.9;  // ablation
  int num_redundant_observers = 3;   // ablation

  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_found_share", self.min_found_share, 0.0, 1.0,
          "a landmark on probation is culled when found in a smaller share of the frames that "
          "should see it");
    field("num_probation_keyframes", self.num_probation_keyframes, 1, 1000,
          "keyframes during which a new landmark is on probation");
    field("min_observations", self.min_observations, 2, 1000,
          "observations that a landmark on probation must reach");
    field("min_observations_age", self.min_observations_age, 0, 1000,
          "keyframes after which it must have reached them");
    field("max_redundant_share", self.max_redundant_share, 0.0, 1.0,
          "a keyframe is culled when more of its landmarks are redundant");
    field("num_redundant_observers", self.num_redundant_observers, 1, 1000,
          "other keyframes that make a landmark redundant by observing it as finely");
  }
};

/// Options of windowed bundle adjustment.
struct BundleAdjusterOptions {
  int max_keyframes = 20;         // ablation
  int max_iterations = 4;         // ablation
  int min_shared_landmarks = 15;  // ablation
  int points_per_keyframe = 100;  // ablation
  double huber_sigmas = 1;        // ablation
  int point_iterations = 5;       // ablation
  int intermediate_frames = 0;    // ablation
  int min_latency_frames = 2;     // ablation
  int max_latency_frames = 4;     // ablation

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("max_keyframes", self.max_keyframes, 2, 1000, "free keyframes of one window");
    field("max_iterations", self.max_iterations, 1, 1000, "iterations of one adjustment");
    field("intermediate_frames", self.intermediate_frames, 0, 30,
          "frames between two keyframes that are adjusted with them: more accurate on a road, and "
          "slower");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("min_shared_landmarks", self.min_shared_landmarks, 1, 10000,
          "landmarks that a keyframe must share with the newest one to belong to its window");
    field("points_per_keyframe", self.points_per_keyframe, 10, 100000,
          "points adjusted jointly with the keyframes, longest tracks first; others follow alone");
    field("huber_sigmas", self.huber_sigmas, 0.01, 100.0,
          "residual at which Huber's loss becomes linear, in standard deviations");
    field("point_iterations", self.point_iterations, 1, 1000,
          "iterations of a point that is adjusted alone");
    field("min_latency_frames", self.min_latency_frames, 1, 100,
          "least number of frames after which a result is used");
    field("max_latency_frames", self.max_latency_frames, 1, 100,
          "largest number of frames after which a result is used");
  }
};

/// Options for estimating the camera during tracking.
struct CalibrationOptions {
  bool enabled = true;
  double focal_sigma = 0.002;         // The value that a board calibration states.
  double k1_sigma = 0.03;             // ablation
  double k2_sigma = 0.02;             // ablation
  double center_sigma_share = 0.006;  // docs/calibration.md
  double tangential_sigma = 0.002;    // docs/calibration.md
  int block_keyframes = 30;           // ablation
  int max_keyframes = 200;            // ablation
  double max_displacement_px = 0.2;   // The measured noise of aligned keypoints.
  int points_per_keyframe = 200;      // ablation
  int max_points = 4000;              // ablation
  int max_iterations = 10;            // ablation
  double huber_sigmas = 1;            // ablation
  double information_factor = 1.5;    // docs/calibration.md
  double stated_share = 1.0 / 3;      // docs/calibration.md
  double gross_error_sigmas = 10;     // ablation
  int min_keyframes = 5;              // ablation
  double growth = 4.0 / 3;            // ablation
  double growth_after_rejection = 2;  // ablation
  int latency_frames = 4;             // ablation
  int max_latency_frames = 20;        // ablation

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("enabled", self.enabled, "false: the camera is taken exactly as given");
    field("focal_sigma", self.focal_sigma, 1e-6, 1.0,
          "standard deviation of a given focal length, as a share of it");
    field("k1_sigma", self.k1_sigma, 1e-6, 10.0,
          "standard deviation of a given k1; the omega of a fov camera has the one that acts like "
          "it");
    field("k2_sigma", self.k2_sigma, 1e-6, 10.0, "standard deviation of a given k2");
    field("center_sigma_share", self.center_sigma_share, 0.0, 1.0,
          "standard deviation of a given principal point, as a share of the image width; 0: it "
          "is exact");
    field("tangential_sigma", self.tangential_sigma, 0.0, 1.0,
          "standard deviation of given p1 and p2; 0: they are exact");
  }
  template <typename Self, typename Visitor>
  static void VisitAdvanced(Self& self, Visitor&& field) {
    field("block_keyframes", self.block_keyframes, 2, 1000,
          "keyframes of a block; the camera is estimated from all blocks");
    field("max_keyframes", self.max_keyframes, 2, 1000,
          "newest keyframes that are adjusted to an estimate of the camera");
    field("max_displacement_px", self.max_displacement_px, 0.0, 1000.0,
          "largest displacement of a pixel by an estimate to which no keyframes are adjusted");
    field("points_per_keyframe", self.points_per_keyframe, 10, 100000,
          "points of each keyframe in an estimate, longest tracks first");
    field("max_points", self.max_points, 10, 10000000, "points of an estimate, about");
    field("max_iterations", self.max_iterations, 1, 1000, "iterations of one estimate");
    field("huber_sigmas", self.huber_sigmas, 0.01, 100.0,
          "residual at which Huber's loss becomes linear, in standard deviations");
    field("information_factor", self.information_factor, 0.01, 1000.0,
          "weight of the observations' information beside the prior");
    field("stated_share", self.stated_share, 0.001, 1.0,
          "share of that information that counts in the standard deviations");
    field("gross_error_sigmas", self.gross_error_sigmas, 1.0, 1e6,
          "observations with a larger residual are left out of an estimate, standard deviations");
    field("min_keyframes", self.min_keyframes, 2, 1000, "keyframes before the first estimate");
    field("growth", self.growth, 1.0, 100.0,
          "growth of the number of keyframes from one estimate to the next, as a factor");
    field("growth_after_rejection", self.growth_after_rejection, 1.0, 100.0,
          "the same factor after an estimate that the prior rejects");
    field("latency_frames", self.latency_frames, 0, 1000,
          "frames after which an estimate is used, beyond one for each of its keyframes");
    field("max_latency_frames", self.max_latency_frames, 1, 1000,
          "largest number of frames after which an estimate is used");
  }
};

/// All options that determine the output of Odometry, apart from the camera and the images.
struct OdometryOptions {
  orb::ExtractorOptions extractor;
  MatchingOptions matching;
  MeasurementOptions measurement;
  InitializerOptions initializer;
  PoseOptimizerOptions pose_optimizer;
  TrackerOptions tracker;
  RelocalizerOptions relocalizer;
  SegmentStartOptions segment_start;
  SegmentJoiningOptions segment_joining;
  KeyframeOptions keyframes;
  LandmarkOptions landmarks;
  CullingOptions culling;
  BundleAdjusterOptions bundle_adjuster;
  CalibrationOptions calibration;

  /// Throws corvo::Error naming the first field out of range, as "<section>.<field>".
  void Validate() const;
  /// Validates the options and returns a copy.
  OdometryOptions Checked() const;

  /// Calls `section(name, options)` for every part.
  template <typename Self, typename Visitor>
  static void VisitSections(Self& self, Visitor&& section) {
    section("extractor", self.extractor);
    section("matching", self.matching);
    section("measurement", self.measurement);
    section("initializer", self.initializer);
    section("pose_optimizer", self.pose_optimizer);
    section("tracker", self.tracker);
    section("relocalizer", self.relocalizer);
    section("segment_start", self.segment_start);
    section("segment_joining", self.segment_joining);
    section("keyframes", self.keyframes);
    section("landmarks", self.landmarks);
    section("culling", self.culling);
    section("bundle_adjuster", self.bundle_adjuster);
    section("calibration", self.calibration);
  }
};

}  // namespace corvo
