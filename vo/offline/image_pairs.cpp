#include "vo/offline/image_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vo/math/median.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {
namespace {

constexpr double kFar = 0.1;    // Displacement that is enough, as a share of the diagonal.
constexpr double kNear = 0.02;  // The least that tells something.
constexpr int kMinMatches = 100;

/// Gaps between two images that are tried: 1, 2, 3, 4, 6, 8, 12, 16, ..., 64.
bool IsGap(int gap) {
  if (gap < 1 || gap > 64) return false;
  while (gap % 2 == 0) gap /= 2;
  return gap == 1 || gap == 3;
}

/// A frame without a camera: MatchFrames looks at no rays.
Frame MakeFrameOf(orb::Features features) {
  Frame frame;
  frame.features = std::move(features);
  return frame;
}

PixelMatches ToPixels(const Frame& first, const Frame& second,
                      const std::vector<double>& octave_scales) {
  PixelMatches pixels;
  for (const orb::Match& match : MatchFrames(first, second)) {
    const int octave =
        std::max(first.keypoint(match.query).octave, second.keypoint(match.train).octave);
    pixels.push_back({first.detected_pixel(match.query), second.detected_pixel(match.train),
                      octave_scales[octave]});
  }
  return pixels;
}

double MedianDisplacement(const PixelMatches& matches) {
  std::vector<double> lengths;
  for (const PixelMatch& match : matches) lengths.push_back((match.second - match.first).norm());
  return Median(std::move(lengths));
}

}  // namespace

ImagePairs::ImagePairs(int num_images, int max_pairs) {
  const int num_starts = std::min(num_images - 1, max_pairs);
  for (int i = 0; i < num_starts; ++i) {
    Start start;
    start.image = static_cast<int>(static_cast<long long>(i) * (num_images - 1) / num_starts);
    starts_.push_back(std::move(start));
  }
}

bool ImagePairs::Needs(int i) const {
  return std::any_of(starts_.begin(), starts_.end(), [i](const Start& start) {
    return start.image == i || (!start.is_done && IsGap(i - start.image));
  });
}

void ImagePairs::Add(int i, const cv::Mat& image, const cv::Mat& mask) {
  if (!Needs(i)) return;
  const double far_px = kFar * std::hypot(image.cols, image.rows);
  const Frame frame = MakeFrameOf(extractor_.Extract(image, mask));
  for (Start& start : starts_) {
    if (start.image == i) start.frame = frame;
    if (!start.is_done && IsGap(i - start.image)) Match(frame, far_px, start);
  }
}

void ImagePairs::Match(const Frame& frame, double far_px, Start& start) const {
  PixelMatches matches = ToPixels(start.frame, frame, extractor_.octave_scales());
  const double displacement_px = MedianDisplacement(matches);
  const double near_px = kNear / kFar * far_px;
  if (matches.size() < kMinMatches) {
    start.is_done = true;
  } else if (displacement_px > std::max(near_px, start.displacement_px)) {
    start.matches = std::move(matches);
    start.displacement_px = displacement_px;
    start.is_done = displacement_px > far_px;
  }
}

std::vector<PixelMatches> ImagePairs::Get() const {
  std::vector<PixelMatches> pairs;
  for (const Start& start : starts_) {
    if (!start.matches.empty()) pairs.push_back(start.matches);
  }
  return pairs;
}

}  // namespace corvo
