// SPDX-License-Identifier: MIT
#include "orb/extractor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "orb/apportion.h"
#include "orb/descriptor.h"
#include "orb/error.h"
#include "orb/level_detail.h"
#include "orb/level_extractor.h"
#include "orb/orientation.h"
#include "orb/pattern_file.h"
#include "orb/pyramid.h"
#include "orb/rounding.h"
#include "orb/window_sums.h"
#include "orb/workers.h"

namespace corvo::orb {
namespace {

std::string SizeText(const cv::Mat& image) {
  return std::to_string(image.cols) + "x" + std::to_string(image.rows);
}

void CheckGray(const char* name, const cv::Mat& image) {
  if (image.type() == CV_8UC1) return;
  throw Error(std::string(name) + " has OpenCV type " + std::to_string(image.type()) +
              "; allowed is 8-bit, one channel (CV_8UC1)");
}

ExtractorOptions Validated(const ExtractorOptions& options) {
  options.Validate();
  return options;
}

int WantedFeatures(const ExtractorOptions& options, cv::Size image) {
  if (options.num_features > 0) return options.num_features;
  return std::max(image.width, image.height) >= 900 ? 2000 : 1000;
}

/// Returns the level's pixel nearest to a keypoint, or std::nullopt if it cannot be described.
std::optional<cv::Point> DescribablePixel(const PyramidLevel& level, const Keypoint& keypoint) {
  const double x = level.LevelX(keypoint.x);
  const double y = level.LevelY(keypoint.y);
  const bool near_image = x >= 0 && x < level.image.cols && y >= 0 && y < level.image.rows;
  if (!near_image) return std::nullopt;  // Also if a coordinate is NaN.
  const cv::Point pixel(RoundHalfUp(x), RoundHalfUp(y));
  if (!InsideBorder(level.image).contains(pixel)) return std::nullopt;
  return pixel;
}

bool IsDirection(float angle_deg) { return angle_deg >= 0.0F && angle_deg < 360.0F; }

/// Describes keypoints of any level; efficient if they are grouped by level and ordered by row.
class KeypointDescriber {
 public:
  KeypointDescriber(const std::vector<PyramidLevel>& levels, const Describer& describer)
      : levels_(levels), describer_(describer) {}

  /// Returns std::nullopt if the keypoint cannot be described. Measures its angle if it has none.
  std::optional<Descriptor> Describe(Keypoint& keypoint) {
    if (keypoint.octave < 0 || keypoint.octave >= static_cast<int>(levels_.size())) return {};
    const PyramidLevel& level = levels_[keypoint.octave];
    const std::optional<cv::Point> pixel = DescribablePixel(level, keypoint);
    if (!pixel) return {};
    if (keypoint.octave != octave_) sums_.Start(level.image);
    octave_ = keypoint.octave;
    if (!IsDirection(keypoint.angle_deg)) {
      keypoint.angle_deg = OrientationDeg(level.image, pixel->x, pixel->y);
    }
    return describer_.Describe(sums_.Row(pixel->y) + pixel->x, sums_.stride(), keypoint.angle_deg);
  }

 private:
  const std::vector<PyramidLevel>& levels_;
  const Describer& describer_;
  int octave_ = -1;  ///< The octave of sums_.
  WindowSumBand sums_;
};

/// Returns the indices of the keypoints ordered by octave, then by row.
std::vector<int> OrderByRow(std::span<const Keypoint> keypoints) {
  std::vector<int> order(keypoints.size());
  std::iota(order.begin(), order.end(), 0);
  // NaN would break the strict weak ordering; keypoints without a finite row sort as row -1.
  const auto row_of = [&](int i) { return std::isfinite(keypoints[i].y) ? keypoints[i].y : -1; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(keypoints[a].octave, row_of(a)) < std::pair(keypoints[b].octave, row_of(b));
  });
  return order;
}

Patch CutPatch(const PyramidLevel& level, const Keypoint& keypoint) {
  const int left = RoundHalfUp(level.LevelX(keypoint.x)) - Patch::kRadius;
  const int top = RoundHalfUp(level.LevelY(keypoint.y)) - Patch::kRadius;
  Patch patch;
  for (int row = 0; row < Patch::kSide; ++row) {
    std::copy_n(level.image.ptr(top + row) + left, Patch::kSide,
                patch.pixels.begin() + row * Patch::kSide);
  }
  return patch;
}

void CutPatches(const std::vector<PyramidLevel>& levels, std::span<const Keypoint> keypoints,
                std::vector<Patch>& patches) {
  patches.resize(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    patches[i] = CutPatch(levels[keypoints[i].octave], keypoints[i]);
  }
}

}  // namespace

void CheckInput(const cv::Mat& image, const cv::Mat& mask) {
  if (image.empty()) throw Error("image is empty");
  CheckGray("image", image);
  if (mask.empty()) return;
  CheckGray("mask", mask);
  if (mask.size() == image.size()) return;
  throw Error("mask is " + SizeText(mask) + "; allowed is the image's size, " + SizeText(image));
}

/// The buffers of one call of Extract().
struct Buffers {
  Buffers(const std::vector<double>& octave_scales, int threads)
      : pyramid(octave_scales),
        levels(octave_scales.size()),
        weights(octave_scales.size()),
        num_corners(octave_scales.size()),
        quotas(octave_scales.size()),
        starts(octave_scales.size()),
        workers(threads) {}

  Pyramid pyramid;
  std::vector<LevelExtractor> levels;
  std::vector<std::int64_t> weights;  ///< Weights of the levels in the quotas.
  std::vector<int> num_corners;
  std::vector<int> quotas;
  std::vector<int> starts;  ///< Index of each level's first feature.
  Workers workers;
};

/// Returns the weight of a level in the quotas. With a grid it is the area, proportional to the
/// number of cells. Without one it is the square root of the level's side, in thousandths: coarse
/// levels, whose corners are more repeatable under blur and noise, get more.
std::int64_t WeightOf(const PyramidLevel& level, bool grid) {
  const std::int64_t area = InsideBorder(level.image).area();
  if (grid) return area;
  return std::llround(1000 * std::sqrt(std::sqrt(static_cast<double>(area))));
}

/// Divides the wanted number of features among the levels from `first_level` on.
void SetQuotas(int wanted, bool grid, int first_level, Buffers& buffers) {
  const std::vector<PyramidLevel>& levels = buffers.pyramid.levels();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    buffers.weights[i] = WeightOf(levels[i], grid);
    const bool is_used = static_cast<int>(i) >= first_level;
    buffers.num_corners[i] = is_used ? buffers.levels[i].num_corners() : 0;
  }
  Apportion(wanted, buffers.weights, buffers.num_corners, buffers.quotas);
  std::exclusive_scan(buffers.quotas.begin(), buffers.quotas.end(), buffers.starts.begin(), 0);
}

/// Lends buffers to concurrent calls, and makes new ones if none are free. Thread-safe.
class BufferPool {
 public:
  std::unique_ptr<Buffers> Take(const std::vector<double>& octave_scales, int threads) {
    const std::scoped_lock lock(mutex_);
    if (buffers_.empty()) return std::make_unique<Buffers>(octave_scales, threads);
    std::unique_ptr<Buffers> taken = std::move(buffers_.back());
    buffers_.pop_back();
    return taken;
  }

  void Return(std::unique_ptr<Buffers> buffers) {
    const std::scoped_lock lock(mutex_);
    buffers_.push_back(std::move(buffers));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Buffers>> buffers_;
};

Extractor::Extractor(const ExtractorOptions& options, int threads)
    : options_(Validated(options)),
      threads_(threads),
      octave_scales_(OctaveScales(options.num_levels, options.scale_factor)),
      describer_(std::make_shared<Describer>(LoadPattern(options.pattern), options.orientation_bins,
                                             options.upright)),
      buffers_(std::make_shared<BufferPool>()) {
  CheckRange("threads", threads, 1, 256);
}

Features Extractor::Extract(const cv::Mat& image, const cv::Mat& mask) const {
  Features features;
  Extract(image, mask, features);
  return features;
}

void Extractor::Extract(const cv::Mat& image, const cv::Mat& mask, Features& features) const {
  Extract(image, mask, features, nullptr);
}

void Extractor::Extract(const cv::Mat& image, const cv::Mat& mask, Features& features,
                        std::vector<Patch>& patches) const {
  Extract(image, mask, features, &patches);
}

void Extractor::Extract(const cv::Mat& image, const cv::Mat& mask, Features& features,
                        std::vector<Patch>* patches) const {
  CheckInput(image, mask);
  std::unique_ptr<Buffers> buffers = buffers_->Take(octave_scales_, threads_);
  buffers->pyramid.Build(image, buffers->workers);
  const std::vector<PyramidLevel>& levels = buffers->pyramid.levels();
  std::vector<LevelExtractor>& extractors = buffers->levels;
  const int num_levels = static_cast<int>(levels.size());
  const int first_level = FindFirstDetailedLevel(levels, options_.min_detail);
  buffers->workers.ForEach(num_levels, [&](int i) {
    if (i >= first_level) extractors[i].Detect(levels[i], mask, options_);
  });
  SetQuotas(WantedFeatures(options_, image.size()), options_.grid, first_level, *buffers);
  const int num_features = buffers->starts.back() + buffers->quotas.back();
  features.keypoints.resize(num_features);
  features.descriptors.resize(num_features);
  buffers->workers.ForEach(num_levels, [&](int i) {
    if (i < first_level) return;
    const std::size_t start = buffers->starts[i];
    const std::size_t count = buffers->quotas[i];
    extractors[i].Describe(levels[i], i, options_, *describer_,
                           {std::span(features.keypoints).subspan(start, count),
                            std::span(features.descriptors).subspan(start, count)});
  });
  if (patches != nullptr) CutPatches(levels, features.keypoints, *patches);
  buffers->pyramid.ReleaseInput();
  buffers_->Return(std::move(buffers));
}

DescribedKeypoints Extractor::Describe(const cv::Mat& image,
                                       std::span<const Keypoint> keypoints) const {
  CheckInput(image, cv::Mat());
  const std::vector<PyramidLevel> levels = BuildPyramid(image, octave_scales_);
  KeypointDescriber describer(levels, *describer_);
  std::vector<Keypoint> oriented(keypoints.begin(), keypoints.end());
  std::vector<std::optional<Descriptor>> descriptors(keypoints.size());
  for (const int i : OrderByRow(keypoints)) descriptors[i] = describer.Describe(oriented[i]);
  DescribedKeypoints described;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    if (!descriptors[i]) continue;
    described.features.keypoints.push_back(oriented[i]);
    described.features.descriptors.push_back(*descriptors[i]);
    described.indices.push_back(static_cast<int>(i));
  }
  return described;
}

}  // namespace corvo::orb
