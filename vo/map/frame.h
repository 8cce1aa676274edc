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

/// The features of one image and the landmarks that they observe. A value type, passed on by
/// moving.
struct Frame {
  int index = 0;  ///< Index of the input frame, from 0.
  TimeNs time_ns = 0;
  orb::Features features;  ///< Keypoints keep the pixel at which they were detected.
  orb::KeypointIndex keypoint_index;
  std::vector<orb::Patch> patches;      ///< Patch around each keypoint; empty if unknown.
  std::vector<Eigen::Vector2d> pixels;  ///< Detected or aligned pixel of each keypoint.
  std::vector<Eigen::Vector2d> rays;    ///< (x/z, y/z) of each of `pixels` in `camera`.
  std::vector<char> is_aligned;         ///< Nonzero if aligned with its landmark's patch.
  std::vector<LandmarkId> landmarks;    ///< Landmark observed by each keypoint, or kNoId.
  SE3 world_from_camera;
  CameraParameters camera;  ///< The camera that `rays` refer to.

  int num_keypoints() const { return static_cast<int>(features.keypoints.size()); }
  const orb::Keypoint& keypoint(int i) const { return features.keypoints[i]; }
  const orb::Descriptor& descriptor(int i) const { return features.descriptors[i]; }
  const Eigen::Vector2d& pixel(int i) const { return pixels[i]; }
  Eigen::Vector2d detected_pixel(int i) const { return {keypoint(i).x, keypoint(i).y}; }
};

/// Makes a frame without landmarks. Keypoints without a ray through the camera (outside the domain
/// of its distortion) are dropped.
Frame MakeFrame(int index, TimeNs time_ns, orb::Features features, const Camera& camera,
                std::vector<orb::Patch> patches = {});

/// Returns whether `mask`, 8-bit and of the image's size, is zero at a keypoint.
bool IsMasked(const cv::Mat& mask, const orb::Keypoint& keypoint);

/// Removes the keypoints at which `mask`, 8-bit and of the image's size, is zero.
void RemoveMaskedKeypoints(const cv::Mat& mask, Frame& frame);

/// Removes all keypoints but those with the given indices, which are ascending.
void SelectKeypoints(const std::vector<int>& kept, Frame& frame);

/// Throws corvo::Error unless the image is 8-bit gray and has the size of the camera.
void CheckImage(const cv::Mat& image, const Camera& camera);

/// Recomputes the rays of a frame if they refer to another camera. A pixel without a ray in
/// `camera` keeps its old ray.
void UpdateRays(const Camera& camera, Frame& frame);

/// Returns the number of keypoints that observe a landmark.
int CountObservedLandmarks(const Frame& frame);

/// Returns the number of entries other than kNoId.
int CountLandmarks(const std::vector<LandmarkId>& landmarks);

/// Returns the memory held by a frame, bytes.
std::size_t NumBytes(const Frame& frame);

}  // namespace corvo
