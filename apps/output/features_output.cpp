#include "apps/output/features_output.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "orb/error.h"
#include "orb/opencv.h"

namespace corvo {
namespace {

/// Of circles, relative to the patches, which would hide the picture.
constexpr float kDrawnSize = 0.3F;

/// Colours that stay apart, blue first (B, G, R).
const cv::Scalar& ColourOf(int octave) {
  static const std::array<cv::Scalar, 8> kColours = {
      cv::Scalar(255, 160, 0), cv::Scalar(255, 255, 0),  cv::Scalar(0, 255, 0),
      cv::Scalar(0, 255, 255), cv::Scalar(0, 165, 255),  cv::Scalar(0, 0, 255),
      cv::Scalar(255, 0, 255), cv::Scalar(255, 255, 255)};
  return kColours[static_cast<std::size_t>(octave) % kColours.size()];
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

/// Draws over `picture` the matches of which is_inlier is `wanted`.
void DrawLines(const cv::Mat& first, const cv::Mat& second, const PictureMatches& pictures,
               bool wanted, const cv::Scalar& colour, cv::Mat& picture) {
  std::vector<cv::DMatch> lines;
  for (std::size_t i = 0; i < pictures.matches.size(); ++i) {
    const orb::Match& match = pictures.matches[i];
    if ((pictures.is_inlier[i] != 0) != wanted) continue;
    lines.emplace_back(match.query, match.train, static_cast<float>(match.distance));
  }
  cv::DrawMatchesFlags flags = cv::DrawMatchesFlags::NOT_DRAW_SINGLE_POINTS;
  if (!picture.empty()) flags |= cv::DrawMatchesFlags::DRAW_OVER_OUTIMG;
  cv::drawMatches(first, PointsOf(pictures.first), second, PointsOf(pictures.second), lines,
                  picture, colour, colour, {}, flags);
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

std::string MatchTable(const PictureMatches& pictures) {
  std::string table = "first,second,first_x,first_y,second_x,second_y,distance,inlier\n";
  for (std::size_t i = 0; i < pictures.matches.size(); ++i) {
    const orb::Match& match = pictures.matches[i];
    const orb::Keypoint& from = pictures.first.keypoints[match.query];
    const orb::Keypoint& to = pictures.second.keypoints[match.train];
    table += fmt::format("{},{},{},{},{},{},{},{}\n", match.query, match.train, from.x, from.y,
                         to.x, to.y, match.distance, pictures.is_inlier[i] != 0 ? 1 : 0);
  }
  return table;
}

cv::Mat DrawFeatures(const cv::Mat& image, const orb::Features& features,
                     const orb::Extractor& extractor) {
  cv::Mat picture;
  cv::cvtColor(image, picture, cv::COLOR_GRAY2BGR);
  const auto flags =
      cv::DrawMatchesFlags::DRAW_RICH_KEYPOINTS | cv::DrawMatchesFlags::DRAW_OVER_OUTIMG;
  for (cv::KeyPoint& keypoint : orb::ToKeyPoints(features.keypoints, extractor.octave_scales())) {
    keypoint.size *= kDrawnSize;
    cv::drawKeypoints(picture, {keypoint}, picture, ColourOf(keypoint.octave), flags);
  }
  return picture;
}

cv::Mat DrawMatches(const cv::Mat& first, const cv::Mat& second, const PictureMatches& pictures) {
  cv::Mat picture;
  DrawLines(first, second, pictures, false, cv::Scalar(0, 0, 255), picture);
  DrawLines(first, second, pictures, true, cv::Scalar(0, 220, 0), picture);
  return picture;
}

void WritePicture(const cv::Mat& picture, const std::string& name, const OutputFolder& output) {
  const std::string file = output.Stage(name).string();
  if (!cv::imwrite(file, picture)) throw Error(fmt::format("{}: cannot be written", file));
}

}  // namespace corvo
