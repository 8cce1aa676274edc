// SPDX-License-Identifier: MIT
#include "vo/mapping/keyframe_policy.h"

#include <gtest/gtest.h>

namespace corvo {
namespace {

TEST(KeyframePolicyTest, KeyframeIsDueIfClearlyFewerLandmarksAreTracked) {
  KeyframeOptions options;
  options.max_tracked_share = 0.9;
  EXPECT_FALSE(NeedsKeyframe({400, 90, 100}, options));
  EXPECT_TRUE(NeedsKeyframe({400, 89, 100}, options));
  EXPECT_FALSE(NeedsKeyframe({400, 300, 100}, options));
}

TEST(KeyframePolicyTest, KeyframeIsDueIfFewKeypointsObserveLandmarks) {
  KeyframeOptions options;
  options.min_seeing_share = 0.1;
  EXPECT_FALSE(NeedsKeyframe({500, 50, 50}, options));
  EXPECT_TRUE(NeedsKeyframe({500, 49, 49}, options));
}

}  // namespace
}  // namespace corvo
