#include "orb/extractor.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "orb/descriptor.h"
#include "orb/error.h"
#include "orb/fast.h"
#include "orb/grid.h"
#include "orb/harris.h"
#include "orb/orientation.h"
#include "orb/pyramid.h"
#include "orb/rounding.h"

namespace corvo::orb {
namespace {

std::string SizeText(const cv::Mat& image) {
  return std::to_string(image.cols) + "x" + std::to_string(image.rows);
}

void CheckGrey(const char* name, const cv::Mat& image) {
  if (image.type() == CV_8UC1) return;
  throw Error(std::string(name) + " has OpenCV type " + std::to_string(image.type()) +
              "; allowed is 8-bit, one channel (CV_8UC1)");
}

void CheckInput(const cv::Mat& image, const cv::Mat& mask) {
  if (image.empty()) throw Error("image is empty");
  CheckGrey("image", image);
  if (mask.empty()) return;
  CheckGrey("mask", mask);
  if (mask.size() == image.size()) return;
  throw Error("mask is " + SizeText(mask) + "; allowed is the image's size, " + SizeText(image));
}

ExtractorOptions Validated(const ExtractorOptions& options) {
  options.Validate();
  return options;
}

int WantedFeatures(const ExtractorOptions& options, int image_width) {
  if (options.num_features > 0) return options.num_features;
  return image_width >= 1000 ? 2000 : 1000;
}

/// Calls `work(level)` for every level, up to `threads` at once (no more than there are
/// processors).
template <typename Work>
void ForEachLevel(int num_levels, int threads, const Work& work) {
  const int usable = std::min(threads, tbb::info::default_concurrency());
  if (usable == 1) {
    for (int level = 0; level < num_levels; ++level) work(level);
    return;
  }
  tbb::task_arena arena(usable);
  arena.execute([&] { tbb::parallel_for(0, num_levels, work); });
}

/// Where a level may have keypoints.
cv::Rect InsideBorder(const cv::Mat& image) {
  return {kBorder, kBorder, std::max(0, image.cols - 2 * kBorder),
          std::max(0, image.rows - 2 * kBorder)};
}

/// Whether the mask keeps a pixel of a level: it is looked up at the nearest input pixel.
bool IsKept(const cv::Mat& mask, const PyramidLevel& level, int x, int y) {
  if (mask.empty()) return true;
  const int column = std::min(RoundHalfUp(level.InputX(x)), mask.cols - 1);
  const int row = std::min(RoundHalfUp(level.InputY(y)), mask.rows - 1);
  return mask.at<std::uint8_t>(row, column) != 0;
}

/// The corners of a level inside border and mask, in row-major order.
std::vector<RankedCorner> DetectCorners(const PyramidLevel& level, const cv::Mat& mask,
                                        const ExtractorOptions& options) {
  std::vector<RankedCorner> corners;
  const auto detected =
      DetectFast(level.image, options.min_fast_threshold, InsideBorder(level.image));
  for (const Corner& corner : detected) {
    if (!IsKept(mask, level, corner.x, corner.y)) continue;
    const bool strong = corner.score >= options.fast_threshold;
    const std::int64_t strength = options.ranking == Ranking::kHarris
                                      ? HarrisResponse(level.image, corner.x, corner.y)
                                      : corner.score;
    corners.push_back({corner.x, corner.y, strong, strength});
  }
  return corners;
}

using LevelCorners = std::vector<std::vector<RankedCorner>>;

/// Quotas of the levels, by area inside the border.
std::vector<int> LevelQuotas(const std::vector<PyramidLevel>& levels, const LevelCorners& corners,
                             int wanted) {
  std::vector<std::int64_t> areas;
  std::vector<int> counts;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const cv::Rect inside = InsideBorder(levels[i].image);
    areas.push_back(std::int64_t{inside.width} * inside.height);
    counts.push_back(static_cast<int>(corners[i].size()));
  }
  return Apportion(wanted, areas, counts);
}

std::vector<RankedCorner> Select(const std::vector<RankedCorner>& corners,
                                 const PyramidLevel& level, int quota,
                                 const ExtractorOptions& options) {
  const std::vector<int> chosen =
      options.grid ? SelectInGrid(corners, InsideBorder(level.image), options.cell_size_px, quota)
                   : SelectStrongest(corners, quota);
  std::vector<RankedCorner> selected;
  selected.reserve(chosen.size());
  for (const int i : chosen) selected.push_back(corners[i]);
  return selected;
}

/// Keypoints and descriptors of the selected corners of one level.
Features DescribeLevel(const PyramidLevel& level, int octave,
                       const std::vector<RankedCorner>& corners, const RotatedPatterns& patterns,
                       bool upright) {
  Features features;
  if (corners.empty()) return features;
  const cv::Mat sums = WindowSums(level.image);
  for (const RankedCorner& corner : corners) {
    const float angle_deg = OrientationDeg(level.image, corner.x, corner.y);
    features.keypoints.push_back({static_cast<float>(level.InputX(corner.x)),
                                  static_cast<float>(level.InputY(corner.y)), angle_deg,
                                  static_cast<float>(corner.strength), octave});
    const Pattern& pattern = upright ? patterns[0] : patterns.Nearest(angle_deg);
    features.descriptors.push_back(Describe(sums, corner.x, corner.y, pattern));
  }
  return features;
}

/// The nearest pixel of the level, if a keypoint there can be described.
std::optional<cv::Point> DescribablePixel(const PyramidLevel& level, const Keypoint& keypoint) {
  const double x = level.LevelX(keypoint.x);
  const double y = level.LevelY(keypoint.y);
  const bool near_image = x >= 0 && x < level.image.cols && y >= 0 && y < level.image.rows;
  if (!near_image) return std::nullopt;  // Also where a coordinate is not a number.
  const cv::Point pixel(RoundHalfUp(x), RoundHalfUp(y));
  if (!InsideBorder(level.image).contains(pixel)) return std::nullopt;
  return pixel;
}

bool IsDirection(float angle_deg) { return angle_deg >= 0.0F && angle_deg < 360.0F; }

/// Describes keypoints of any octave one by one; levels are smoothed when first needed.
class KeypointDescriber {
 public:
  KeypointDescriber(const std::vector<PyramidLevel>& levels, const RotatedPatterns& patterns,
                    bool upright)
      : levels_(levels), patterns_(patterns), upright_(upright), sums_(levels.size()) {}

  /// None where the keypoint cannot be described. Measures its angle if it has none.
  std::optional<Descriptor> operator()(Keypoint& keypoint) {
    if (keypoint.octave < 0 || keypoint.octave >= static_cast<int>(levels_.size())) return {};
    const PyramidLevel& level = levels_[keypoint.octave];
    const std::optional<cv::Point> pixel = DescribablePixel(level, keypoint);
    if (!pixel) return {};
    cv::Mat& sums = sums_[keypoint.octave];
    if (sums.empty()) sums = WindowSums(level.image);
    if (!IsDirection(keypoint.angle_deg)) {
      keypoint.angle_deg = OrientationDeg(level.image, pixel->x, pixel->y);
    }
    const Pattern& pattern = upright_ ? patterns_[0] : patterns_.Nearest(keypoint.angle_deg);
    return Describe(sums, pixel->x, pixel->y, pattern);
  }

 private:
  const std::vector<PyramidLevel>& levels_;
  const RotatedPatterns& patterns_;
  bool upright_;
  std::vector<cv::Mat> sums_;
};

Features Concatenate(const std::vector<Features>& parts) {
  Features all;
  for (const Features& part : parts) {
    all.keypoints.insert(all.keypoints.end(), part.keypoints.begin(), part.keypoints.end());
    all.descriptors.insert(all.descriptors.end(), part.descriptors.begin(), part.descriptors.end());
  }
  return all;
}

}  // namespace

Extractor::Extractor(const ExtractorOptions& options, int threads)
    : options_(Validated(options)),
      threads_(threads),
      octave_scales_(OctaveScales(options.num_levels, options.scale_factor)),
      patterns_(MakeBriefPattern(), options.orientation_bins) {
  CheckRange("threads", threads, 1, 256);
}

Features Extractor::Extract(const cv::Mat& image, const cv::Mat& mask) const {
  CheckInput(image, mask);
  const std::vector<PyramidLevel> levels = BuildPyramid(image, octave_scales_);
  const int num_levels = static_cast<int>(levels.size());

  LevelCorners corners(num_levels);
  ForEachLevel(num_levels, threads_,
               [&](int i) { corners[i] = DetectCorners(levels[i], mask, options_); });

  const int wanted = WantedFeatures(options_, image.cols);
  const std::vector<int> quotas = LevelQuotas(levels, corners, wanted);
  std::vector<Features> parts(num_levels);
  ForEachLevel(num_levels, threads_, [&](int i) {
    const auto selected = Select(corners[i], levels[i], quotas[i], options_);
    parts[i] = DescribeLevel(levels[i], i, selected, patterns_, options_.upright);
  });
  return Concatenate(parts);
}

DescribedKeypoints Extractor::Describe(const cv::Mat& image,
                                       std::span<const Keypoint> keypoints) const {
  CheckInput(image, cv::Mat());
  const std::vector<PyramidLevel> levels = BuildPyramid(image, octave_scales_);
  KeypointDescriber describe(levels, patterns_, options_.upright);
  DescribedKeypoints described;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    Keypoint keypoint = keypoints[i];
    const std::optional<Descriptor> descriptor = describe(keypoint);
    if (!descriptor) continue;
    described.features.keypoints.push_back(keypoint);
    described.features.descriptors.push_back(*descriptor);
    described.indices.push_back(static_cast<int>(i));
  }
  return described;
}

}  // namespace corvo::orb
