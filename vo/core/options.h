#pragma once

#include "orb/options.h"

namespace corvo {

// Every options struct names each field once in `Visit`, with range and meaning: validation, the
// configuration reader and `configs/default.yaml` come from it. See orb::ExtractorOptions::Visit.

/// Two-view initialisation.
struct InitializerOptions {
  int min_matches = 100;
  double min_parallax_sigmas = 3.0;
  double max_homography_share = 0.45;
  int min_points = 50;
  double min_parallax_deg = 1.0;
  int max_waiting_frames = 100;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("min_matches", self.min_matches, 20, 100000, "matches between the two views");
    field("min_parallax_sigmas", self.min_parallax_sigmas, 0.0, 1000.0,
          "median parallax before a motion is looked for, in units of the keypoint noise");
    field("max_homography_share", self.max_homography_share, 0.0, 1.0,
          "a larger share of the homography in the scores of both models: the scene is planar");
    field("min_points", self.min_points, 10, 100000, "triangulated points of the first map");
    field("min_parallax_deg", self.min_parallax_deg, 0.0, 90.0,
          "parallax that min_points points must reach");
    field("max_waiting_frames", self.max_waiting_frames, 2, 10000,
          "frames kept before initialisation; they get poses afterwards");
  }
};

/// Locating a frame in the map.
struct TrackerOptions {
  double search_radius_px = 15;
  int min_matches = 20;
  int min_inliers = 20;
  int max_local_keyframes = 30;
  int max_distance = 95;
  double max_ratio = 0.8;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("search_radius_px", self.search_radius_px, 1.0, 500.0,
          "around the predicted pixel, times the octave's scale; doubled once if too few match");
    field("min_matches", self.min_matches, 6, 10000,
          "matches with the frame before; with fewer, the next wider search is tried");
    field("min_inliers", self.min_inliers, 15, 10000, "landmarks that must agree with the pose");
    field("max_local_keyframes", self.max_local_keyframes, 1, 1000,
          "keyframes whose landmarks are looked for");
    field("max_distance", self.max_distance, 1, 256, "between matching descriptors, bits");
    field("max_ratio", self.max_ratio, 0.1, 1.0,
          "distance of the nearest descriptor over that of the second nearest");
  }
};

/// Finding the track again after it was lost.
struct RelocalizerOptions {
  int max_keyframes = 200;
  int max_candidates = 5;
  int min_inliers = 25;
  double max_lost_s = 1.0;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("max_keyframes", self.max_keyframes, 1, 100000,
          "newest kept keyframes of the segment in which a lost frame is looked for");
    field("max_candidates", self.max_candidates, 1, 1000,
          "of them, the most similar, from which the frame is tracked");
    field("min_inliers", self.min_inliers, 15, 10000, "landmarks that must agree with the pose");
    field("max_lost_s", self.max_lost_s, 0.0, 1e6,
          "time since the last pose after which a new segment may start, s");
  }
};

/// When a frame becomes a keyframe, and how keyframes and landmarks are made and culled.
struct KeyframeOptions {
  double max_tracked_share = 0.75;
  double min_seeing_share = 0.07;
  int num_neighbors = 6;
  double min_parallax_deg = 0.6;
  int max_distance = 65;
  double min_found_share = 0.25;
  double max_redundant_share = 0.9;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("max_tracked_share", self.max_tracked_share, 0.0, 1.0,
          "a keyframe is due when fewer of the nearest keyframe's landmarks are tracked");
    field("min_seeing_share", self.min_seeing_share, 0.0, 1.0,
          "and when fewer of the frame's keypoints see landmarks");
    field("num_neighbors", self.num_neighbors, 1, 100,
          "covisible keyframes with which a new one is triangulated and fused");
    field("min_parallax_deg", self.min_parallax_deg, 0.0, 90.0,
          "of a new landmark, times the scale of the coarser octave that sees it");
    field("max_distance", self.max_distance, 1, 256,
          "between the descriptors of a new or fused landmark, bits");
    field("min_found_share", self.min_found_share, 0.0, 1.0,
          "a landmark found in a smaller share of the frames that should see it is culled");
    field("max_redundant_share", self.max_redundant_share, 0.0, 1.0,
          "a keyframe is culled when more of its landmarks are seen by three others as finely");
  }
};

/// Windowed bundle adjustment.
struct BundleAdjusterOptions {
  double keypoint_sigma_px = 1.0;
  double aligned_sigma_px = 0.6;
  int max_keyframes = 10;
  int min_shared_landmarks = 15;
  int points_per_keyframe = 100;
  int max_iterations = 4;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("keypoint_sigma_px", self.keypoint_sigma_px, 0.01, 100.0,
          "standard deviation of a keypoint, px of its own level; used wherever errors are judged");
    field("aligned_sigma_px", self.aligned_sigma_px, 0.01, 100.0,
          "the same, of a keypoint that was aligned with its landmark's patch");
    field("max_keyframes", self.max_keyframes, 2, 1000, "that move in one adjustment");
    field("min_shared_landmarks", self.min_shared_landmarks, 1, 10000,
          "with the newest keyframe, for a keyframe to move");
    field("points_per_keyframe", self.points_per_keyframe, 10, 100000,
          "that move with the keyframes, the longest tracks first; others are adjusted afterwards");
    field("max_iterations", self.max_iterations, 1, 1000, "of one adjustment");
  }
};

/// Estimating the camera while it runs.
struct CalibrationOptions {
  bool enabled = true;
  double focal_sigma = 0.002;
  double k1_sigma = 0.03;
  double k2_sigma = 0.02;
  int max_keyframes = 60;
  int points_per_keyframe = 200;
  int max_iterations = 10;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("enabled", self.enabled, "false: the camera is exactly what it is given as");
    field("focal_sigma", self.focal_sigma, 1e-6, 1.0,
          "standard deviation of the given focal length, as a share of it");
    field("k1_sigma", self.k1_sigma, 1e-6, 10.0, "of the given k1 of a pinhole camera");
    field("k2_sigma", self.k2_sigma, 1e-6, 10.0, "of the given k2");
    field("max_keyframes", self.max_keyframes, 2, 1000, "that tell the camera, the newest");
    field("points_per_keyframe", self.points_per_keyframe, 10, 100000,
          "that tell the camera, the longest tracks first; at most 4000 together");
    field("max_iterations", self.max_iterations, 1, 1000, "of one estimate");
  }
};

/// Everything that decides the output of Odometry, apart from the camera and the images.
struct OdometryOptions {
  orb::ExtractorOptions extractor;
  InitializerOptions initializer;
  TrackerOptions tracker;
  RelocalizerOptions relocalizer;
  KeyframeOptions keyframes;
  BundleAdjusterOptions bundle_adjuster;
  CalibrationOptions calibration;

  /// Throws corvo::Error naming the first field out of range, as "<section>.<field>".
  void Validate() const;

  /// Calls `section(name, options)` for every part.
  template <typename Self, typename Visitor>
  static void VisitSections(Self& self, Visitor&& section) {
    section("extractor", self.extractor);
    section("initializer", self.initializer);
    section("tracker", self.tracker);
    section("relocalizer", self.relocalizer);
    section("keyframes", self.keyframes);
    section("bundle_adjuster", self.bundle_adjuster);
    section("calibration", self.calibration);
  }
};

}  // namespace corvo
