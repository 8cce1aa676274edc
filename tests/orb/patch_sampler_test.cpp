// SPDX-License-Identifier: MIT
#include "orb/patch_sampler.h"

#include <gtest/gtest.h>

#include "orb/extractor.h"
#include "tests/orb/images.h"
#include "tests/orb/pattern_access.h"

namespace corvo::orb {
namespace {

TEST(PositionAtTest, CoversThePatchRowByRow) {
  EXPECT_EQ(kNumPositions, 729);
  EXPECT_EQ(PositionAt(0), (Offset{-13, -13}));
  EXPECT_EQ(PositionAt(1), (Offset{-12, -13}));
  EXPECT_EQ(PositionAt(728), (Offset{13, 13}));
  for (int i = 0; i < kNumPositions; ++i) EXPECT_EQ(test::PositionOf(PositionAt(i)), i);
}

TEST(PatchSamplerTest, SumsReproduceTheDescriptorBits) {
  const cv::Mat image = test::ShapesImage({320, 240}, 5);
  const Pattern pattern = MakeBriefPattern();
  for (const bool upright : {false, true}) {
    ExtractorOptions options;
    options.pattern = "brief";
    options.upright = upright;
    const Features features = Extractor(options).Extract(image);
    ASSERT_GT(features.keypoints.size(), 300U);
    const auto sums = PatchSampler(options).Sample(image, features.keypoints);
    ASSERT_EQ(sums.size(), features.keypoints.size());
    for (std::size_t k = 0; k < sums.size(); ++k) {
      for (int i = 0; i < kNumTests; ++i) {
        const bool darker =
            sums[k][test::PositionOf(pattern[i].p)] < sums[k][test::PositionOf(pattern[i].q)];
        ASSERT_EQ(test::Bit(features.descriptors[k], i), darker)
            << "keypoint " << k << ", test " << i;
      }
    }
  }
}

}  // namespace
}  // namespace corvo::orb
