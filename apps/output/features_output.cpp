// SPDX-License-Identifier: MIT
#include "apps/output/features_output.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <opencv2/features2d.hpp>

#include "apps/output/image_file.h"
#include "orb/opencv.h"

namespace corvo {
namespace {

/// The size of the circles relative to the patches. Full-size circles would hide the image.
constexpr float kDrawnSize = 0.3F;

/// Returns one of eight distinct colors (B, G, R), starting with blue.
const cv::Scalar& ColorOf(int octave) {
  static const std::array<cv::Scalar, 8> kColors = {
      cv::Scalar(255, 160, 0), cv::Scalar(255, 255, 0),  cv::Scalar(0, 255, 0),
      cv::Scalar(0, 255, 255), cv::Scalar(0, 165, 255),  cv::Scalar(0, 0, 255),
      cv::Scalar(255, 0, 255), cv::Scalar(255, 255, 255)};
  return kColors[static_cast<std::size_t>(octave) % kColors.size()];
}

std::string Hexadecimal(const orb::Descriptor& descriptor) {
  return fmt::format("{:02x}", fmt::join(descriptor.bytes, ""));
}

std::vector<cv::KeyPoint> PointsOf(const orb::Features& features) {
  std::vector<cv::KeyPoint> points;
  for (const orb::Keypoint& keypoint : features.keypoints) {
    points.emplace_back(keypoint.x, keypoint.y, 1.0F);
  }
  return points;
}

/// Draws either the inliers or the outliers of the matches over `image`.
void DrawLines(const cv::Mat& first, const cv::Mat& second, const ImageMatches& pair, bool inliers,
               cv::Mat& image) {
  const cv::Scalar color = inliers ? cv::Scalar(0, 220, 0) : cv::Scalar(0, 0, 255);
  std::vector<cv::DMatch> lines;
  for (std::size_t i = 0; i < pair.matches.size(); ++i) {
    const orb::Match& match = pair.matches[i];
    if ((pair.is_inlier[i] != 0) != inliers) continue;
    lines.emplace_back(match.query, match.train, static_cast<float>(match.distance));
  }
  cv::DrawMatchesFlags flags = cv::DrawMatchesFlags::NOT_DRAW_SINGLE_POINTS;
  if (!image.empty()) flags |= cv::DrawMatchesFlags::DRAW_OVER_OUTIMG;
  cv::drawMatches(first, PointsOf(pair.first), second, PointsOf(pair.second), lines, image, color,
                  color, {}, flags);
}

}  // namespace

std::string FeatureTable(const orb::Features& features) {
  std::string table = "x,y,octave,angle,response,descriptor\n";
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    const orb::Keypoint& keypoint = features.keypoints[i];
    table +=
        fmt::format("{},{},{},{},{},{}\n", keypoint.x, keypoint.y, keypoint.octave,
                    keypoint.angle_deg, keypoint.response, Hexadecimal(features.descriptors[i]));
  }
  return table;
}

std::string MatchTable(const ImageMatches& pair) {
  std::string table = "first,second,first_x,first_y,second_x,second_y,distance,inlier\n";
  for (std::size_t i = 0; i < pair.matches.size(); ++i) {
    const orb::Match& match = pair.matches[i];
    const orb::Keypoint& from = pair.first.keypoints[match.query];
    const orb::Keypoint& to = pair.second.keypoints[match.train];
    table += fmt::format("{},{},{},{},{},{},{},{}\n", match.query, match.train, from.x, from.y,
                         to.x, to.y, match.distance, pair.is_inlier[i] != 0 ? 1 : 0);
  }
  return table;
}

cv::Mat DrawFeatures(const cv::Mat& image, const orb::Features& features,
                     const orb::Extractor& extractor) {
  cv::Mat drawing;
  cv::cvtColor(image, drawing, cv::COLOR_GRAY2BGR);
  const auto flags =
      cv::DrawMatchesFlags::DRAW_RICH_KEYPOINTS | cv::DrawMatchesFlags::DRAW_OVER_OUTIMG;
  for (cv::KeyPoint& keypoint : orb::ToKeyPoints(features.keypoints, extractor.octave_scales())) {
    keypoint.size *= kDrawnSize;
    cv::drawKeypoints(drawing, {keypoint}, drawing, ColorOf(keypoint.octave), flags);
  }
  return drawing;
}

cv::Mat DrawMatches(const cv::Mat& first, const cv::Mat& second, const ImageMatches& pair) {
  cv::Mat drawing;
  DrawLines(first, second, pair, false, drawing);
  DrawLines(first, second, pair, true, drawing);
  return drawing;
}

void WriteImage(const cv::Mat& image, const std::string& name, const OutputFolder& output) {
  output.Write(name, EncodeImage(image, ".png"));
}

}  // namespace corvo
