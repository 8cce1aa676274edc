// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "orb/matcher.h"
#include "orb/patch.h"
#include "orb/types.h"
#include "vo/camera/camera.h"
#include "vo/core/conventions.h"
#include "vo/lie/se3.h"

namespace corvo {

/// One image's features and what they are known to see. A value that is moved on.
struct Frame {
  int index = 0;  ///< Of the input frame, from 0.
  TimeNs time_ns = 0;
  orb::Features features;  ///< Keypoints keep their measured pixel.
  orb::KeypointIndex keypoint_index;
  std::vector<orb::Patch> patches;      ///< Around each keypoint; empty if not known.
  std::vector<Eigen::Vector2d> pixels;  ///< Of each keypoint: where it was detected or aligned.
  std::vector<Eigen::Vector2d> rays;    ///< (x/z, y/z) of each of `pixels`, by `camera`.
  std::vector<char> is_aligned;         ///< With the patch of the landmark that it sees.
  std::vector<LandmarkId> landmarks;    ///< Seen by each keypoint, or kNoId.
  SE3 world_from_camera;
  CameraParameters camera;  ///< That the rays are of.

  int num_keypoints() const { return static_cast<int>(features.keypoints.size()); }
  const orb::Keypoint& keypoint(int i) const { return features.keypoints[i]; }
  const orb::Descriptor& descriptor(int i) const { return features.descriptors[i]; }
  const Eigen::Vector2d& pixel(int i) const { return pixels[i]; }
  Eigen::Vector2d detected_pixel(int i) const { return {keypoint(i).x, keypoint(i).y}; }
};

/// Keypoints without a ray through the camera (outside the domain of its distortion) are dropped.
Frame MakeFrame(int index, TimeNs time_ns, orb::Features features, const Camera& camera,
                std::vector<orb::Patch> patches = {});

/// Throws corvo::Error unless an image is 8-bit gray and of the camera's size.
void CheckImage(const cv::Mat& image, const Camera& camera);

/// Makes a frame's rays those of this camera, if they are of another; a pixel that it sees by no
/// ray keeps the old one.
void UpdateRays(const Camera& camera, Frame& frame);

/// Keypoints that see a landmark.
int CountObservedLandmarks(const Frame& frame);

/// Memory held.
std::size_t NumBytes(const Frame& frame);

}  // namespace corvo
