#include "apps/run/focal_start.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/run/odometry_pass.h"
#include "orb/error.h"
#include "vo/offline/image_pairs.h"

namespace corvo {
namespace {

constexpr int kMaxPairs = 16;  // Of all sequences.

/// Of a sequence whose end alone tells.
int CountImages(ImageSource source, const Interruption& interruption) {
  int count = 0;
  for (; source.Skip(); ++count) interruption.ThrowIfRequested();
  return count;
}

/// Adds a sequence's pairs, and checks or sets the size of its images.
void AddPairs(const ImageOpener& open, int max_pairs, const Interruption& interruption,
              cv::Size& size, std::vector<PixelMatches>& pairs) {
  ImageSource source = open();
  const bool is_counted = !source.list().images.empty();
  ImagePairs sequence(is_counted ? *source.size() : CountImages(open(), interruption), max_pairs);
  const TimedImage& first = source.First();
  if (size.empty()) size = first.image.size();
  for (int i = 0;; ++i) {
    interruption.ThrowIfRequested();
    if (!sequence.Needs(i)) {
      if (!source.Skip()) break;
      continue;
    }
    const std::optional<TimedImage> next = source.Next();
    if (!next) break;
    if (next->image.size() != size) {
      throw Error(fmt::format("{}: the image is {} x {} px, others {} x {} px", next->name,
                              next->image.cols, next->image.rows, size.width, size.height));
    }
    sequence.Add(i, next->image, next->mask);
  }
  for (PixelMatches& matches : sequence.Get()) pairs.push_back(std::move(matches));
}

}  // namespace

FocalSearchResult SearchFocal(const std::vector<ImageOpener>& sequences,
                              const Interruption& interruption) {
  cv::Size size;
  std::vector<PixelMatches> pairs;
  const int max_pairs = std::max(1, kMaxPairs / std::max<int>(1, sequences.size()));
  for (const ImageOpener& open : sequences) AddPairs(open, max_pairs, interruption, size, pairs);
  return SearchFocal(pairs, size.width, size.height);
}

CameraPrior MakeFocalPrior(const FocalSearchResult& search) {
  constexpr double kMinSigma = 0.1;
  constexpr double kMaxSigma = 0.5;
  constexpr double kK1Sigma = 0.1;
  constexpr double kK2Sigma = 0.05;
  const double center_sigma_px = 0.01 * search.camera.width;
  const double focal_sigma = std::clamp(search.focal_sigma, kMinSigma, kMaxSigma);
  return {search.camera,
          {{"focal", focal_sigma},
           {"cx", center_sigma_px},
           {"cy", center_sigma_px},
           {"k1", kK1Sigma},
           {"k2", kK2Sigma}}};
}

CameraPrior FindFocalLength(const std::vector<ImageOpener>& sequences,
                            const Interruption& interruption) {
  const FocalSearchResult search = SearchFocal(sequences, interruption);
  CameraPrior prior = MakeFocalPrior(search);
  if (search.is_determined) {
    spdlog::info("focal search: {:.1f} px, from {} pairs of images", prior.given.fx,
                 search.num_pairs);
  } else {
    spdlog::warn(
        "the images do not determine the focal length ({} pairs of images); it starts from "
        "{:.0f} px to within {:.0f}%. Film something that is not flat, and turn while moving, not "
        "straight along the axis",
        search.num_pairs, prior.given.fx, 100 * prior.free.front().sigma);
  }
  return prior;
}

CameraPrior FindCamera(const ImageOpener& open, const OdometryOptions& options, int threads,
                       const Interruption& interruption) {
  constexpr int kMaxImages = 500;
  CameraPrior prior = FindFocalLength({open}, interruption);
  Odometry odometry(prior, options, threads);
  PassThrough(open(), "finding the camera", interruption, odometry, kMaxImages);
  prior.given = odometry.camera().parameters();
  spdlog::info("first pass: {:.1f} px", prior.given.fx);
  return prior;
}

}  // namespace corvo
