// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo {

/// A map from the gray levels of 16-bit images, which may use fewer bits, to 8 bits. It ascends.
class GrayLevels {
 public:
  /// Keeps the upper eight of `bits` bits (8 to 16); higher levels become 255. Throws corvo::Error
  /// for any other number.
  explicit GrayLevels(int bits = 16);

  /// Maps `low` and below to 0, `high` and above to 255, and is linear between them.
  GrayLevels(int low, int high);

  std::uint8_t Of(std::uint16_t level) const { return levels_[level]; }

  /// Converts a 16-bit image, each channel alike; returns an 8-bit one as it is.
  cv::Mat ToByte(const cv::Mat& image) const;

  /// Describes the map, such as "12 bits" or "levels 6900 to 8600".
  std::string text() const;

  /// The number of bits, or std::nullopt for a map of two levels.
  std::optional<int> bits() const { return bits_; }
  /// The levels that are mapped to 0 and 255.
  int low() const { return low_; }
  int high() const { return high_; }

 private:
  std::vector<std::uint8_t> levels_;  ///< By 16-bit level.
  std::optional<int> bits_;
  int low_ = 0;
  int high_ = 0;
};

/// The gray levels that occur in 16-bit images.
class GrayHistogram {
 public:
  /// Counts the levels of a 16-bit gray image.
  void Add(const cv::Mat& image);

  /// Returns the map for the images counted: the upper eight of as many bits as the greatest level
  /// has (10, 12, 14 or 16), or, if all but 0.1% at both ends use less than a quarter of these, as
  /// in thermal images, their range and a tenth more at both ends.
  GrayLevels Levels() const;

 private:
  /// Returns the level below which `share` of the counted pixels lie.
  int Percentile(double share) const;

  std::vector<std::int64_t> counts_ = std::vector<std::int64_t>(1 << 16, 0);
  std::int64_t num_pixels_ = 0;
};

}  // namespace corvo
