// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace corvo::orb {

/// The score that ranks corners inside a grid cell.
enum class Ranking { kFast, kHarris };

/// Returns "fast" or "harris".
std::string_view ToString(Ranking ranking);

/// Returns the ranking with this name. Throws corvo::Error if there is none.
Ranking ParseRanking(std::string_view name);

/// The options of Extractor. `Visit` calls the visitor for every field, with its range and meaning;
/// validation, the configuration reader and the generated `configs/default.yaml` all use it.
struct ExtractorOptions {
  int num_features = 0;
  int num_levels = 8;
  double scale_factor = 1.2;
  double min_detail = 0.6;
  int fast_threshold = 20;
  int min_fast_threshold = 7;
  Ranking ranking = Ranking::kFast;
  bool grid = true;
  int cell_size_px = 24;
  int orientation_bins = 30;
  bool upright = false;
  std::string pattern = "learned";

  /// Throws corvo::Error with the name of the first field that is out of range, of
  /// min_fast_threshold if it exceeds fast_threshold, or of pattern if LoadPattern() throws.
  void Validate() const;

  /// Calls `field(name, value, min, max, meaning)` for numbers and `field(name, value, meaning)`
  /// for booleans, enumerations and strings, in order. `Self` is `ExtractorOptions` or `const
  /// ExtractorOptions`.
  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("num_features", self.num_features, 0, 100000,
          "keypoints an image; 0: 1000, or 2000 for images whose longer side has at least 900 px");
    field("num_levels", self.num_levels, 1, 32, "levels of the image pyramid");
    field("scale_factor", self.scale_factor, 1.01, 4.0, "ratio of one level's size to the next");
    field(
        "min_detail", self.min_detail, 0.0, 1.0,
        "finest levels with less detail, as in blurred or enlarged images, get no keypoints; 1 is "
        "a sharp photograph, 0.5 an image enlarged to twice its size");
    field("fast_threshold", self.fast_threshold, 1, 254, "FAST threshold, gray levels");
    field("min_fast_threshold", self.min_fast_threshold, 1, 254,
          "FAST threshold of cells that are short of corners; at most fast_threshold");
    field("ranking", self.ranking, "what ranks corners: fast (score) or harris (response)");
    field("grid", self.grid, "spread keypoints over grid cells; false: the strongest anywhere");
    field("cell_size_px", self.cell_size_px, 8, 1000, "side of a grid cell, px of its own level");
    field("orientation_bins", self.orientation_bins, 1, 256, "directions of the rotated pattern");
    field("upright", self.upright, "do not rotate the pattern (BRIEF)");
    field("pattern", self.pattern,
          "binary tests: learned or free (from photographs; free: that may be used for anything), "
          "brief (sampled), or a file of corvo learn");
  }
};

/// Returns the shorter side of an image in units of 480 px, at least 1: the factor by which lengths
/// that are given in pixels grow in large images.
double ImageScale(int width, int height);

/// Returns `options` with further levels for images of more than 480 px on the shorter side, so
/// that the coarsest level shows as large a part of the image as in smaller ones. Blur and fast
/// motion cover more pixels in large images.
ExtractorOptions AdaptToImage(ExtractorOptions options, int width, int height);

}  // namespace corvo::orb
