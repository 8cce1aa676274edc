// SPDX-License-Identifier: MIT
#include "orb/learned_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "orb/extractor.h"
#include "orb/matcher.h"
#include "orb/pattern_file.h"
#include "tests/orb/images.h"
#include "tests/support/data.h"

namespace corvo::orb {
namespace {

Extractor WithPattern(const std::string& pattern) {
  ExtractorOptions options;
  options.num_features = 1000;
  options.pattern = pattern;
  return Extractor(options);
}

TEST(LearnedPatternTest, EqualsTheFileWrittenByCorvoLearn) {
  EXPECT_EQ(ReadPattern(test::SourceDir() / "orb" / "learned_pattern.inc"), LearnedPattern());
  EXPECT_EQ(ReadPattern(test::SourceDir() / "orb" / "free_pattern.inc"), LoadPattern("free"));
}

TEST(LearnedPatternTest, WindowsDoNotOverlap) {
  for (const Pattern& pattern : {LearnedPattern(), FreePattern()}) {
    for (const auto& [p, q] : pattern) {
      EXPECT_GE(std::max(std::abs(p.x - q.x), std::abs(p.y - q.y)), 5);
    }
  }
}

/// Returns bit `i` of every descriptor as +1 (set) or -1.
std::vector<int> Signs(const std::vector<Descriptor>& descriptors, int i) {
  std::vector<int> signs;
  for (const Descriptor& descriptor : descriptors) {
    signs.push_back((descriptor.bytes[i / 8] >> i % 8 & 1) != 0 ? 1 : -1);
  }
  return signs;
}

/// Returns the root mean square of the correlations between different tests over the keypoints of
/// RealImages().
double RmsCorrelation(const std::string& pattern) {
  std::vector<Descriptor> descriptors;
  for (const std::string& image : test::RealImages()) {
    const Features features = WithPattern(pattern).Extract(test::ReadGray(image));
    descriptors.insert(descriptors.end(), features.descriptors.begin(), features.descriptors.end());
  }
  std::vector<std::vector<int>> signs;
  for (int i = 0; i < kNumTests; ++i) signs.push_back(Signs(descriptors, i));
  const auto n = static_cast<double>(descriptors.size());
  const auto mean = [&](int i) { return std::reduce(signs[i].begin(), signs[i].end()) / n; };
  double squares = 0;
  for (int i = 0; i < kNumTests; ++i) {
    for (int j = 0; j < i; ++j) {
      const double product =
          std::inner_product(signs[i].begin(), signs[i].end(), signs[j].begin(), 0) / n;
      const double covariance = product - mean(i) * mean(j);
      squares += covariance * covariance / ((1 - mean(i) * mean(i)) * (1 - mean(j) * mean(j)));
    }
  }
  return std::sqrt(squares / (kNumTests * (kNumTests - 1) / 2));
}

TEST(LearnedPatternTest, TestsCorrelateLessThanThoseOfTheSampledPattern) {
  CORVO_SKIP_IF_SHORT();
  CORVO_REQUIRE_DATA("oxford_affine");
  EXPECT_LT(RmsCorrelation("learned"), RmsCorrelation("brief"));
}

/// Counts mutual nearest neighbors within 3 px of the position that the homography predicts.
int CountCorrect(const Features& first, const Features& second,
                 const cv::Matx33d& second_from_first) {
  const auto matches =
      CrossCheck(DistanceTest(FindNearest(first.descriptors, second.descriptors), 256),
                 FindNearest(second.descriptors, first.descriptors));
  int count = 0;
  for (const Match& match : matches) {
    const Keypoint& from = first.keypoints[match.query];
    const Keypoint& to = second.keypoints[match.train];
    const cv::Vec3d at = second_from_first * cv::Vec3d(from.x, from.y, 1);
    count += std::hypot(at[0] / at[2] - to.x, at[1] / at[2] - to.y) <= 3;
  }
  return count;
}

/// Returns the total number of correct matches of the first image of a folder with each other
/// image.
int CountCorrect(const std::string& folder, const std::string& extension,
                 const std::string& pattern) {
  const Extractor extractor = WithPattern(pattern);
  const auto extract = [&](int i) {
    return extractor.Extract(test::ReadGray(folder + "/img" + std::to_string(i) + extension));
  };
  const Features first = extract(1);
  int count = 0;
  for (int i = 2; i <= 6; ++i) {
    const auto homography = test::ReadHomography(folder + "/H1to" + std::to_string(i) + "p");
    count += CountCorrect(first, extract(i), homography);
  }
  return count;
}

TEST(LearnedPatternTest, MatchesMoreThanTheSampledPattern) {
  for (const std::string name : {"boat", "graf", "bikes", "ubc"}) {
    const std::string folder = "oxford_affine/" + name;
    CORVO_REQUIRE_DATA(folder);
    const std::string extension = name == "boat" ? ".pgm" : ".ppm";
    const int learned = CountCorrect(folder, extension, "learned");
    const int free = CountCorrect(folder, extension, "free");
    const int sampled = CountCorrect(folder, extension, "brief");
    RecordProperty(name, std::to_string(learned) + ", " + std::to_string(free) + " of " +
                             std::to_string(sampled));
    EXPECT_GT(learned, sampled) << name;
    EXPECT_GT(free, sampled) << name;
    EXPECT_GT(free, 0.97 * learned) << name;
  }
}

}  // namespace
}  // namespace corvo::orb
