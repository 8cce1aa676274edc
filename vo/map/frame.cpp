// SPDX-License-Identifier: MIT
#include "vo/map/frame.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {

Frame MakeFrame(int index, TimeNs time_ns, orb::Features features, const Camera& camera,
                std::vector<orb::Patch> patches) {
  Frame frame;
  frame.index = index;
  frame.time_ns = time_ns;
  frame.camera = camera.parameters();
  const std::size_t num_keypoints = features.keypoints.size();
  frame.features.keypoints.reserve(num_keypoints);
  frame.features.descriptors.reserve(num_keypoints);
  frame.patches.reserve(patches.size());
  frame.pixels.reserve(num_keypoints);
  frame.rays.reserve(num_keypoints);
  frame.is_aligned.reserve(num_keypoints);
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    const orb::Keypoint& keypoint = features.keypoints[i];
    const std::optional<Eigen::Vector2d> ray =
        camera.Undistort(Eigen::Vector2d(keypoint.x, keypoint.y));
    if (!ray) continue;
    frame.features.keypoints.push_back(keypoint);
    frame.features.descriptors.push_back(features.descriptors[i]);
    frame.pixels.emplace_back(keypoint.x, keypoint.y);
    frame.rays.push_back(*ray);
    frame.is_aligned.push_back(0);
    if (!patches.empty()) frame.patches.push_back(patches[i]);
  }
  frame.landmarks.assign(frame.rays.size(), kNoId);
  frame.keypoint_index = orb::KeypointIndex(frame.features.keypoints);
  return frame;
}

bool IsMasked(const cv::Mat& mask, const orb::Keypoint& keypoint) {
  return mask.at<uchar>(static_cast<int>(keypoint.y), static_cast<int>(keypoint.x)) == 0;
}

void RemoveMaskedKeypoints(const cv::Mat& mask, Frame& frame) {
  std::vector<int> kept;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (!IsMasked(mask, frame.keypoint(k))) kept.push_back(k);
  }
  SelectKeypoints(kept, frame);
}

void SelectKeypoints(const std::vector<int>& kept, Frame& frame) {
  const auto select = [&](auto& values) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> selected;
    for (const int k : kept) selected.push_back(values[k]);
    values = std::move(selected);
  };
  select(frame.features.keypoints);
  select(frame.features.descriptors);
  select(frame.patches);
  select(frame.pixels);
  select(frame.rays);
  select(frame.is_aligned);
  select(frame.landmarks);
  frame.keypoint_index = orb::KeypointIndex(frame.features.keypoints);
}

void CheckImage(const cv::Mat& image, const Camera& camera) {
  if (image.type() != CV_8UC1) {
    throw Error(fmt::format("image has type {}; allowed is 8-bit with one channel (CV_8UC1)",
                            cv::typeToString(image.type())));
  }
  if (image.cols != camera.width() || image.rows != camera.height()) {
    throw Error(fmt::format("image is {}x{}; the camera says {}x{}", image.cols, image.rows,
                            camera.width(), camera.height()));
  }
}

void UpdateRays(const Camera& camera, Frame& frame) {
  if (frame.camera == camera.parameters()) return;
  frame.camera = camera.parameters();
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    frame.rays[k] = camera.Undistort(frame.pixels[k]).value_or(frame.rays[k]);
  }
}

int CountObservedLandmarks(const Frame& frame) { return CountLandmarks(frame.landmarks); }

int CountLandmarks(const std::vector<LandmarkId>& landmarks) {
  return static_cast<int>(landmarks.size() - std::count(landmarks.begin(), landmarks.end(), kNoId));
}

std::size_t NumBytes(const Frame& frame) {
  return sizeof frame + frame.keypoint_index.num_bytes() +
         frame.features.keypoints.capacity() * sizeof(orb::Keypoint) +
         frame.features.descriptors.capacity() * sizeof(orb::Descriptor) +
         frame.patches.capacity() * sizeof(orb::Patch) +
         (frame.pixels.capacity() + frame.rays.capacity()) * sizeof(Eigen::Vector2d) +
         frame.is_aligned.capacity() + frame.landmarks.capacity() * sizeof(LandmarkId);
}

}  // namespace corvo
