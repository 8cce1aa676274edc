// SPDX-License-Identifier: MIT
#include "tests/support/matchers.h"

#include <gmock/gmock.h>

#include <limits>

namespace corvo::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Returns the explanation of a matcher for a value that does not match.
template <typename Matcher, typename Value>
std::string Explain(const Matcher& matcher, const Value& value) {
  ::testing::StringMatchResultListener listener;
  ::testing::SafeMatcherCast<const Value&>(matcher).MatchAndExplain(value, &listener);
  return listener.str();
}

TEST(MatchersTest, MatrixMismatchNamesTheEntryAndTheTolerance) {
  const Eigen::Vector2d expected(1, 2);
  EXPECT_THAT(Eigen::Vector2d(1.01, 2), IsMatrixNear(expected, 0.02));
  EXPECT_THAT(Eigen::Vector2d(1, 2.25), Not(IsMatrixNear(expected, 0.02)));
  EXPECT_THAT(Explain(IsMatrixNear(expected, 0.02), Eigen::Vector2d(1, 2.25)),
              HasSubstr("entry (1, 0) is 0.25, more than 0.02"));
}

TEST(MatchersTest, MatricesOfOtherSizesDoNotMatch) {
  EXPECT_THAT(Eigen::Vector2d(1, 2), Not(IsMatrixNear(Eigen::Vector3d(1, 2, 3), 10)));
}

TEST(MatchersTest, NanNeverMatches) {
  EXPECT_THAT(Eigen::Vector2d(1, kNaN), Not(IsMatrixNear(Eigen::Vector2d(1, 2), 10)));
  EXPECT_THAT(Eigen::Vector2d(1, kNaN), Not(IsMatrixNear(Eigen::Vector2d(1, kNaN), 10)));
  const SE3 pose(SO3(), Eigen::Vector3d(kNaN, 0, 0));
  EXPECT_THAT(pose, Not(IsPoseNear(SE3(), 180, 1e9)));
  EXPECT_THAT(Explain(IsPoseNear(SE3(), 180, 1e9), pose), HasSubstr("distance is nan"));
}

TEST(MatchersTest, PoseMismatchNamesTheExceededThreshold) {
  const SE3 pose(SO3::Exp(Eigen::Vector3d(0, 0, 0.1)), Eigen::Vector3d(0, 3, 4));
  EXPECT_THAT(pose, IsPoseNear(SE3(), 5.73, 5.0));
  EXPECT_THAT(Explain(IsPoseNear(SE3(), 5.72, 5.0), pose), HasSubstr("angle, deg, is 5.7"));
  EXPECT_THAT(Explain(IsPoseNear(SE3(), 5.73, 4.9), pose), HasSubstr("distance is 5,"));
  EXPECT_THAT(pose.rotation(), Not(IsRotationNear(SO3(), 5.72)));
}

TEST(MatchersTest, SimilarityComparesScalesByTheirRatio) {
  const Sim3 twice(2, SO3(), Eigen::Vector3d::Zero());
  EXPECT_THAT(twice, IsSimilarityNear(Sim3(), 0.0, 0.0, 0.7));
  EXPECT_THAT(twice, Not(IsSimilarityNear(Sim3(), 0.0, 0.0, 0.69)));
  EXPECT_THAT(Sim3(), Not(IsSimilarityNear(twice, 0.0, 0.0, 0.69)));
}

TEST(MatchersTest, ThrowsErrorRequiresEveryText) {
  const auto thrower = [] { throw Error("width is 0; allowed is 1 to 9"); };
  EXPECT_THAT(thrower, ThrowsError("width", "1 to 9"));
  EXPECT_THAT(thrower, Not(ThrowsError("width", "height")));
  EXPECT_THAT([] {}, Not(ThrowsError("")));
}

}  // namespace
}  // namespace corvo::test
