// SPDX-License-Identifier: MIT
#include "vo/offline/image_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vo/core/option_fields.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

/// Returns a frame without a camera: MatchFrames() uses no rays.
Frame MakeFrameOf(orb::Features features) {
  Frame frame;
  frame.features = std::move(features);
  return frame;
}

double MedianDisplacement(const PixelMatches& matches) {
  std::vector<double> lengths;
  for (const PixelMatch& match : matches) lengths.push_back((match.second - match.first).norm());
  return Median(std::move(lengths));
}

}  // namespace

void ImagePairOptions::Validate() const {
  extractor.Validate();
  CheckFields("image_pairs", *this);
}

ImagePairs::ImagePairs(int num_images, const ImagePairOptions& options)
    : options_(options), extractor_(options.extractor) {
  options.Validate();
  const int num_starts = std::min(num_images - 1, options.max_pairs);
  for (int i = 0; i < num_starts; ++i) {
    Start start;
    start.image = static_cast<int>(static_cast<long long>(i) * (num_images - 1) / num_starts);
    starts_.push_back(std::move(start));
  }
}

bool ImagePairs::IsGap(int gap) const {
  if (gap < 1 || gap > options_.max_gap) return false;
  while (gap % 2 == 0) gap /= 2;
  return gap == 1 || gap == 3;
}

bool ImagePairs::Needs(int i) const {
  return std::any_of(starts_.begin(), starts_.end(), [this, i](const Start& start) {
    return start.image == i || (!start.is_done && IsGap(i - start.image));
  });
}

void ImagePairs::Add(int i, const cv::Mat& image, const cv::Mat& mask) {
  if (!Needs(i)) return;
  const double diagonal_px = std::hypot(image.cols, image.rows);
  const Frame frame = MakeFrameOf(extractor_.Extract(image, mask));
  for (Start& start : starts_) {
    if (start.image == i) start.frame = frame;
    if (!start.is_done && IsGap(i - start.image)) Match(frame, diagonal_px, start);
  }
}

void ImagePairs::Match(const Frame& frame, double diagonal_px, Start& start) const {
  PixelMatches matches = MatchPixels(start.frame, frame);
  const double displacement_px = MedianDisplacement(matches);
  const double min_px = options_.min_displacement * diagonal_px;
  if (static_cast<int>(matches.size()) < options_.min_matches) {
    start.is_done = true;
  } else if (displacement_px > std::max(min_px, start.displacement_px)) {
    start.matches = std::move(matches);
    start.displacement_px = displacement_px;
    start.is_done = displacement_px > options_.far_displacement * diagonal_px;
  }
}

PixelMatches ImagePairs::MatchPixels(const Frame& first, const Frame& second) const {
  PixelMatches pixels;
  for (const orb::Match& match : MatchFrames(first, second, options_.matching)) {
    const int octave =
        std::max(first.keypoint(match.query).octave, second.keypoint(match.train).octave);
    pixels.push_back({first.detected_pixel(match.query), second.detected_pixel(match.train),
                      extractor_.octave_scales()[octave]});
  }
  return pixels;
}

std::vector<PixelMatches> ImagePairs::Get() const {
  std::vector<PixelMatches> pairs;
  for (const Start& start : starts_) {
    if (!start.matches.empty()) pairs.push_back(start.matches);
  }
  return pairs;
}

}  // namespace corvo
