// SPDX-License-Identifier: MIT
#include "orb/options.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "orb/error.h"
#include "orb/pattern_file.h"

namespace corvo::orb {
namespace {

/// Throws corvo::Error if a number is out of its range; accepts fields without a range.
struct CheckField {
  template <typename T>
  void operator()(std::string_view name, const T& value, T min, T max, std::string_view) const {
    CheckRange(name, value, min, max);
  }
  template <typename T>
  void operator()(std::string_view, const T&, std::string_view) const {}
};

void CheckPattern(const std::string& pattern) {
  try {
    LoadPattern(pattern);
  } catch (const Error& error) {
    throw Error(std::string("pattern: ") + error.what());
  }
}

}  // namespace

std::string_view ToString(Ranking ranking) {
  return ranking == Ranking::kHarris ? "harris" : "fast";
}

Ranking ParseRanking(std::string_view name) {
  if (name == "fast") return Ranking::kFast;
  if (name == "harris") return Ranking::kHarris;
  throw Error("ranking is \"" + std::string(name) + "\"; allowed is fast or harris");
}

void ExtractorOptions::Validate() const {
  Visit(*this, CheckField{});
  CheckRange("min_fast_threshold", min_fast_threshold, 1, fast_threshold);
  CheckPattern(pattern);
}

double ImageScale(int width, int height) {
  constexpr double kShorterSide = 480;
  return std::max(1.0, std::min(width, height) / kShorterSide);
}

ExtractorOptions AdaptToImage(ExtractorOptions options, int width, int height) {
  constexpr int kMaxLevels = 32;
  const int further = static_cast<int>(
      std::lround(std::log(ImageScale(width, height)) / std::log(options.scale_factor)));
  options.num_levels =
      std::max(options.num_levels, std::min(kMaxLevels, options.num_levels + further));
  return options;
}

}  // namespace corvo::orb
