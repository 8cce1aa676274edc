// SPDX-License-Identifier: MIT
#include <vector>

#include "orb/extractor.h"
#include "orb/keypoint_index.h"
#include "orb/matcher.h"
#include "tests/fuzz/targets.h"

namespace corvo::fuzz {
namespace {

orb::ExtractorOptions TakeExtractorOptions(Input& input) {
  orb::ExtractorOptions options;
  options.num_features = input.Int(0, 2000);
  options.num_levels = input.Int(1, 32);
  options.scale_factor = input.Real(1.01, 4);
  options.min_detail = input.Real(0, 1);
  options.fast_threshold = input.Int(1, 254);
  options.min_fast_threshold = input.Int(1, options.fast_threshold);
  options.ranking = input.Bool() ? orb::Ranking::kFast : orb::Ranking::kHarris;
  options.grid = input.Bool();
  options.cell_size_px = input.Int(8, 1000);
  options.orientation_bins = input.Int(1, 256);
  options.upright = input.Bool();
  options.pattern = input.Bool() ? "learned" : "brief";
  return options;
}

/// Returns an image whose rows repeat the bytes that are left: a part of a larger matrix, so that
/// reading beyond a row is not reading within the image.
cv::Mat TakeImage(int width, int height, Input& input) {
  const Bytes bytes = input.rest();
  cv::Mat image(height, width + 3, CV_8UC1, cv::Scalar(0));
  std::size_t next = 0;
  for (int y = 0; y < height && !bytes.empty(); ++y) {
    for (int x = 0; x < width; ++x) image.at<std::uint8_t>(y, x) = bytes[next++ % bytes.size()];
    next += y;
  }
  return image.colRange(0, width);
}

void RequireFeatures(const orb::Features& features, const cv::Mat& image) {
  Require(features.keypoints.size() == features.descriptors.size(), "keypoints have descriptors");
  for (const orb::Keypoint& keypoint : features.keypoints) {
    Require(keypoint.x >= -0.5F && keypoint.x < static_cast<float>(image.cols) - 0.5F &&
                keypoint.y >= -0.5F && keypoint.y < static_cast<float>(image.rows) - 0.5F,
            "keypoints lie in the image");
    Require(keypoint.angle_deg >= 0 && keypoint.angle_deg < 360, "angles are in [0, 360)");
    Require(std::isfinite(keypoint.response), "responses are finite");
  }
}

std::vector<orb::Keypoint> TakeKeypoints(Input& input) {
  std::vector<orb::Keypoint> keypoints(input.Int(0, 8));
  for (orb::Keypoint& keypoint : keypoints) {
    keypoint.x = static_cast<float>(input.Bool() ? input.Real(-50, 300) : input.Number(1e30));
    keypoint.y = static_cast<float>(input.Real(-50, 300));
    keypoint.angle_deg = static_cast<float>(input.Real(-400, 400));
    keypoint.octave = input.Bool() ? input.Int(-1, 33) : input.Raw<int>();
  }
  return keypoints;
}

}  // namespace

void FuzzFeatures(Bytes bytes) {
  Input input(bytes);
  const orb::ExtractorOptions options = TakeExtractorOptions(input);
  const int width = input.Int(1, 200), height = input.Int(1, 200);
  const bool is_masked = input.Bool();
  const std::vector<orb::Keypoint> keypoints = TakeKeypoints(input);
  const cv::Mat image = TakeImage(width, height, input);
  AllowError([&] {
    const orb::Extractor extractor(options);
    orb::Features features;
    std::vector<orb::Patch> patches;
    extractor.Extract(image, is_masked ? image : cv::Mat(), features, patches);
    RequireFeatures(features, image);
    extractor.Describe(image, keypoints);
    orb::CrossCheck(orb::DistanceTest(orb::FindNearest(features.descriptors, features.descriptors),
                                      input.Int(0, 256)),
                    orb::FindNearest(features.descriptors, features.descriptors));
    const orb::KeypointIndex index(keypoints);
    std::vector<int> found;
    index.Find({static_cast<float>(input.Number(1e30)), 5, 1e9F, -1, 40}, found);
    Require(found.size() <= keypoints.size(), "a keypoint is found once");
  });
}

}  // namespace corvo::fuzz
