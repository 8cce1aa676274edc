// SPDX-License-Identifier: MIT
#include "orb/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/matchers.h"

namespace corvo::orb {
namespace {

using test::ThrowsError;

template <typename Change>
auto Validating(const Change& change) {
  return [change] {
    ExtractorOptions options;
    change(options);
    options.Validate();
  };
}

TEST(ExtractorOptionsTest, DefaultsAreValid) { EXPECT_NO_THROW(ExtractorOptions{}.Validate()); }

TEST(ExtractorOptionsTest, ErrorsNameFieldValueAndRange) {
  EXPECT_THAT(Validating([](auto& o) { o.num_features = -1; }),
              ThrowsError("num_features", "-1", "0 to 100000"));
  EXPECT_THAT(Validating([](auto& o) { o.num_levels = 0; }), ThrowsError("num_levels", "0"));
  EXPECT_THAT(Validating([](auto& o) { o.num_levels = 33; }), ThrowsError("num_levels", "33"));
  EXPECT_THAT(Validating([](auto& o) { o.scale_factor = 1.0; }), ThrowsError("scale_factor"));
  EXPECT_THAT(Validating([](auto& o) { o.scale_factor = std::nan(""); }),
              ThrowsError("scale_factor", "nan"));
  EXPECT_THAT(Validating([](auto& o) { o.fast_threshold = 255; }), ThrowsError("fast_threshold"));
  EXPECT_THAT(Validating([](auto& o) { o.cell_size_px = 7; }), ThrowsError("cell_size_px"));
  EXPECT_THAT(Validating([](auto& o) { o.orientation_bins = 257; }),
              ThrowsError("orientation_bins", "257", "1 to 256"));
  EXPECT_THAT(Validating([](auto& o) { o.pattern = "biref"; }),
              ThrowsError("pattern: \"biref\"", "allowed is learned, brief"));
}

TEST(ExtractorOptionsTest, LowerThresholdMayNotExceedTheHigher) {
  EXPECT_NO_THROW(Validating([](auto& o) { o.min_fast_threshold = o.fast_threshold; })());
  EXPECT_THAT(Validating([](auto& o) { o.min_fast_threshold = 21; }),
              ThrowsError("min_fast_threshold", "21", "1 to 20"));
}

TEST(RankingTest, NamesAndRankingsCorrespond) {
  for (const Ranking ranking : {Ranking::kFast, Ranking::kHarris}) {
    EXPECT_EQ(ParseRanking(ToString(ranking)), ranking);
  }
  EXPECT_EQ(ToString(Ranking::kFast), "fast");
  EXPECT_EQ(ToString(Ranking::kHarris), "harris");
  EXPECT_THAT([] { ParseRanking("Fast"); }, ThrowsError("ranking", "Fast", "fast or harris"));
}

TEST(AdaptToImage, AddsLevelsThatMakeUpForTheSize) {
  const ExtractorOptions options;
  EXPECT_EQ(AdaptToImage(options, 640, 480).num_levels, 8);
  EXPECT_EQ(AdaptToImage(options, 160, 120).num_levels, 8);
  EXPECT_EQ(AdaptToImage(options, 1241, 376).num_levels, 8);
  EXPECT_EQ(AdaptToImage(options, 1280, 960).num_levels, 12);  // 1.2^4 is about 2.
  EXPECT_EQ(AdaptToImage(options, 960, 1280).num_levels, 12);
  EXPECT_EQ(AdaptToImage(options, 100000, 100000).num_levels, 32);
}

}  // namespace
}  // namespace corvo::orb
