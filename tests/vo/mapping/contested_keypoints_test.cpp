// SPDX-License-Identifier: MIT
#include "vo/mapping/contested_keypoints.h"

#include <gtest/gtest.h>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// Returns a frame with keypoints on a grid of 10 px. Every second one observes a landmark.
Frame MakeGridFrame() {
  test::Random random(1);
  orb::Features features;
  for (int y = 20; y < 460; y += 10) {
    for (int x = 20; x < 620; x += 10) {
      orb::Keypoint keypoint;
      keypoint.x = static_cast<float>(x);
      keypoint.y = static_cast<float>(y);
      features.keypoints.push_back(keypoint);
      features.descriptors.push_back(test::RandomDescriptor(random));
    }
  }
  Frame frame = MakeFrame(0, 0, features, test::PinholeCamera());
  for (int k = 0; k < frame.num_keypoints(); k += 2) frame.landmarks[k] = k;
  return frame;
}

TEST(ContestedKeypointsTest, KeypointsAmongContradictionsAreRemoved) {
  Frame frame = MakeGridFrame();
  std::vector<int> contradictions;
  for (int k = 0; k < frame.num_keypoints(); k += 2) {
    if (frame.pixel(k).x() > 250) continue;
    contradictions.push_back(k);
    frame.landmarks[k] = kNoId;
  }
  const int num_landmarks = CountObservedLandmarks(frame);
  const int num_keypoints = frame.num_keypoints();
  const double share = RemoveContestedKeypoints(contradictions, frame);
  EXPECT_NEAR(share, 1 - static_cast<double>(frame.num_keypoints()) / num_keypoints, 1e-12);
  EXPECT_EQ(CountObservedLandmarks(frame), num_landmarks);
  int num_free = 0;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    EXPECT_GT(frame.pixel(k).x(), 220) << k;
    num_free += frame.landmarks[k] == kNoId;
  }
  EXPECT_GT(num_free, 700);
}

TEST(ContestedKeypointsTest, ScatteredContradictionsRemoveNothing) {
  Frame frame = MakeGridFrame();
  std::vector<int> contradictions;
  for (int k = 0; k < frame.num_keypoints(); k += 8) {
    contradictions.push_back(k);
    frame.landmarks[k] = kNoId;
  }
  const int num_keypoints = frame.num_keypoints();
  EXPECT_EQ(RemoveContestedKeypoints(contradictions, frame), 0);
  EXPECT_EQ(frame.num_keypoints(), num_keypoints);
}

}  // namespace
}  // namespace corvo
