// SPDX-License-Identifier: MIT
#include "vo/mapping/variance_factor.h"

#include <gtest/gtest.h>

namespace corvo {
namespace {

PoseDependence ErrorsOf(SquaredErrors aligned, SquaredErrors detected) {
  PoseDependence dependence;
  dependence.aligned = aligned;
  dependence.detected = detected;
  return dependence;
}

TEST(VarianceFactorTest, IsTheMeanSquaredErrorOfEachKindOfKeypoint) {
  VarianceFactor factor;
  const PoseDependence frame = ErrorsOf({30, 100}, {80, 100});
  EXPECT_EQ(factor.Of(frame), 1);
  factor.Add(frame);
  EXPECT_DOUBLE_EQ(factor.aligned(), 0.3);
  EXPECT_DOUBLE_EQ(factor.detected(), 0.8);
  EXPECT_DOUBLE_EQ(factor.Of(ErrorsOf({0, 300}, {0, 100})), 0.75 * 0.3 + 0.25 * 0.8);
}

TEST(VarianceFactorTest, FollowsTheNoiseWithinTensOfFrames) {
  VarianceFactor factor;
  factor.Add(ErrorsOf({30, 100}, {}));
  factor.Add(ErrorsOf({90, 100}, {}));
  EXPECT_GT(factor.aligned(), 0.3);
  EXPECT_LT(factor.aligned(), 0.4);
  for (int i = 0; i < 40; ++i) factor.Add(ErrorsOf({90, 100}, {}));
  EXPECT_NEAR(factor.aligned(), 0.9, 0.01);
}

TEST(VarianceFactorTest, FewKeypointsAreNoMeasurement) {
  VarianceFactor factor;
  factor.Add(ErrorsOf({90, 10}, {}));
  EXPECT_EQ(factor.aligned(), 1);
  EXPECT_EQ(factor.Of(ErrorsOf({}, {})), 1);
}

}  // namespace
}  // namespace corvo
