// SPDX-License-Identifier: MIT
#include "apps/output/track_drawings.h"

#include <algorithm>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/output/durable_file.h"
#include "apps/output/image_file.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Not the name of the manifest of a result: both may be in one folder.
constexpr const char* kDrawingsManifest = ".drawings.manifest.json";

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

/// Returns whether the file is named like a drawing: digits and ".jpg".
bool IsDrawing(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ".jpg" &&
         std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
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

TrackDrawings::TrackDrawings(const fs::path& folder, bool replaces_foreign) : folder_(folder) {
  if (folder_.empty()) return;
  std::error_code error;
  made_folder_ = fs::create_directories(folder_, error);
  if (error)
    throw Error(fmt::format("{}: cannot be created: {}", folder_.string(), error.message()));
  const fs::path manifest = folder_ / kDrawingsManifest;
  const bool is_foreign = fs::exists(manifest) && !ReadManifest(manifest);
  earlier_ = ReadManifest(manifest).value_or(Manifest());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const ManifestFile* listed = earlier_.Find(entry.path().filename().string());
    const bool is_own = listed != nullptr && IsUnchanged(entry.path(), *listed);
    if (replaces_foreign || (!is_foreign && (is_own || !IsDrawing(entry.path())))) continue;
    throw Error(
        fmt::format("{}: not a drawing of an earlier corvo, or changed since; nothing was "
                    "replaced: choose another folder, or use --force",
                    (is_foreign ? manifest : entry.path()).string()));
  }
}

TrackDrawings::~TrackDrawings() {
  std::error_code ignored;
  if (written_.files.empty() && made_folder_) fs::remove(folder_, ignored);
  if (written_.files.empty()) return;
  try {
    WriteFile(folder_ / kDrawingsManifest, ToText(written_));
  } catch (const Error&) {  // The drawings then count as not written by corvo.
  }
}

void TrackDrawings::RemoveEarlier() {
  std::error_code ignored;
  fs::remove(folder_ / kDrawingsManifest, ignored);
  for (const ManifestFile& file : earlier_.files) {
    if (IsUnchanged(folder_ / file.name, file)) fs::remove(folder_ / file.name, ignored);
  }
}

void TrackDrawings::Add(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                        const FrameResult& result) {
  if (folder_.empty()) return;
  if (written_.files.empty()) RemoveEarlier();
  const std::string name = fmt::format("{:06}.jpg", result.index);
  const std::string bytes = EncodeImage(DrawTracks(image, mask, frame, result, previous_), ".jpg");
  WriteFile(folder_ / name, bytes);
  written_.files.push_back({name, bytes.size(), Crc32(bytes)});
  previous_ = PixelsOfLandmarks(frame);
}

}  // namespace corvo
