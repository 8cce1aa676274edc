#include "vo/keyframe_policy.h"

#include <gtest/gtest.h>

namespace corvo {
namespace {

TEST(KeyframePolicyTest, KeyframeIsDueWhenClearlyLessIsSeen) {
  KeyframeOptions options;
  options.max_tracked_share = 0.9;
  EXPECT_FALSE(NeedsKeyframe({90, 100}, options));
  EXPECT_TRUE(NeedsKeyframe({89, 100}, options));
  EXPECT_FALSE(NeedsKeyframe({300, 100}, options));
}

}  // namespace
}  // namespace corvo
