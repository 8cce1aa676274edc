// SPDX-License-Identifier: MIT
#include "apps/output/track_drawings.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "orb/error.h"

namespace corvo {
namespace {

const cv::Scalar kTracked(80, 220, 60);  // BGR
const cv::Scalar kTrail(60, 160, 255);
const cv::Scalar kExcluded(0.2, 0.2, 0.6);  // Factors of B, G and R.
const cv::Scalar kUntracked(150, 150, 150);
const cv::Scalar kCaption(255, 255, 255);
const cv::Scalar kReasonCaption(60, 220, 255);

cv::Point2f PixelOf(const Frame& frame, int keypoint) {
  const orb::Keypoint& point = frame.keypoint(keypoint);
  return {point.x, point.y};
}

std::map<LandmarkId, cv::Point2f> PixelsOfLandmarks(const Frame& frame) {
  std::map<LandmarkId, cv::Point2f> pixels;
  for (int i = 0; i < frame.num_keypoints(); ++i) {
    if (frame.landmarks[i] != kNoId) pixels[frame.landmarks[i]] = PixelOf(frame, i);
  }
  return pixels;
}

void DrawCaption(const FrameResult& result, cv::Mat& image) {
  const bool has_reason = result.reason != Reason::kNone;
  std::string text = fmt::format("{}  {}", result.index, ToString(result.state));
  if (has_reason) text += fmt::format(": {}", ToString(result.reason));
  text += fmt::format("  {} inliers", result.num_inliers);
  const cv::Point place(6, image.rows - 8);
  const cv::Scalar& color = has_reason ? kReasonCaption : kCaption;
  cv::putText(image, text, place, cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(image, text, place, cv::FONT_HERSHEY_SIMPLEX, 0.5, color, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat DrawTracks(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                   const FrameResult& result, const std::map<LandmarkId, cv::Point2f>& previous) {
  cv::Mat drawing;
  cv::cvtColor(image, drawing, cv::COLOR_GRAY2BGR);
  if (!mask.empty()) {
    cv::Mat dark;
    cv::multiply(drawing, kExcluded, dark);
    dark.copyTo(drawing, mask == 0);
  }
  for (int i = 0; i < frame.num_keypoints(); ++i) {
    if (frame.landmarks[i] == kNoId) cv::circle(drawing, PixelOf(frame, i), 1, kUntracked, -1);
  }
  for (const auto& [landmark, pixel] : PixelsOfLandmarks(frame)) {
    const auto before = previous.find(landmark);
    if (before != previous.end()) cv::line(drawing, before->second, pixel, kTrail, 1, cv::LINE_AA);
    cv::circle(drawing, pixel, 3, kTracked, 1, cv::LINE_AA);
  }
  DrawCaption(result, drawing);
  return drawing;
}

TrackDrawings::TrackDrawings(const std::filesystem::path& folder) : folder_(folder) {
  if (folder_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw Error(fmt::format("{}: cannot be created: {}", folder_.string(), error.message()));
}

void TrackDrawings::Add(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                        const FrameResult& result) {
  if (folder_.empty()) return;
  const std::filesystem::path file = folder_ / fmt::format("{:06}.jpg", result.index);
  if (!cv::imwrite(file.string(), DrawTracks(image, mask, frame, result, previous_))) {
    throw Error(fmt::format("{}: cannot be written", file.string()));
  }
  previous_ = PixelsOfLandmarks(frame);
}

}  // namespace corvo
