// SPDX-License-Identifier: MIT
#include "apps/run/known_length_arguments.h"

#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

/// The fields of an option's value.
class Fields {
 public:
  Fields(std::string_view option, const std::string& text)
      : option_(option), fields_(SplitFields(text)) {}

  std::size_t size() const { return fields_.size(); }
  int Frame(std::size_t i) const { return static_cast<int>(std::lround(Number(i, 0, 1e9))); }
  double Meters(std::size_t i) const { return Number(i, 1e-9, 1e9); }
  Eigen::Vector2d Pixel(std::size_t i) const {
    constexpr double kMaxPixel = 1e6;
    return {Number(i, -0.5, kMaxPixel), Number(i + 1, -0.5, kMaxPixel)};
  }

 private:
  double Number(std::size_t i, double min, double max) const {
    const double value = ParseNumber(fields_[i], option_ + ": ");
    CheckRange(option_, value, min, max);
    return value;
  }

  std::string option_;
  std::vector<std::string> fields_;
};

}  // namespace

KnownDistance ParseKnownDistance(const std::string& text) {
  const Fields fields("--known-distance", text);
  if (fields.size() != 3) {
    throw Error(fmt::format("--known-distance: '{}' is not FRAME,FRAME,METERS", text));
  }
  return {fields.Frame(0), fields.Frame(1), fields.Meters(2)};
}

KnownSize ParseKnownSize(const std::string& text) {
  constexpr std::size_t kFieldsOfView = 5;
  const Fields fields("--known-size", text);
  if (fields.size() < 2 * kFieldsOfView + 1 || fields.size() % kFieldsOfView != 1) {
    throw Error(fmt::format("--known-size: '{}' is not FRAME,X,Y,X,Y,FRAME,X,Y,X,Y,METERS", text));
  }
  KnownSize known;
  for (std::size_t i = 0; i + 1 < fields.size(); i += kFieldsOfView) {
    known.views.push_back({fields.Frame(i), fields.Pixel(i + 1), fields.Pixel(i + 3)});
  }
  known.meters = fields.Meters(fields.size() - 1);
  return known;
}

}  // namespace corvo
