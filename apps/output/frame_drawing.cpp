// SPDX-License-Identifier: MIT
#include "apps/output/frame_drawing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/output/reasons.h"

namespace corvo {
namespace {

constexpr int kMaxAge = 64;         // Frames; older tracks have the same color.
constexpr int kDarkest = 80;        // Of the 256 colors; darker ones cannot be told from the image.
constexpr double kTintShare = 0.4;  // Of the tint in what is masked.
constexpr int kSubpixelBits = 4;    // Fractional bits of coordinates that are drawn.
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

const cv::Scalar kOutline(30, 30, 30);  // BGR
const cv::Scalar kTint(0, 94, 213);
const cv::Scalar kUntracked(150, 150, 150);
const cv::Scalar kBar(28, 28, 28);
const cv::Scalar kText(255, 255, 255);
const cv::Scalar kReasonText(60, 200, 255);
const cv::Scalar kMinorText(170, 170, 170);

/// Returns the factor by which texts, dots and lines are larger than in an image of 0.5 megapixels.
double UnitOf(const cv::Mat& image) {
  return std::max(0.5, std::sqrt(static_cast<double>(image.total())) / 700);
}

/// Returns the color map "viridis", whose steps are equal to the eye with any color vision.
cv::Mat MakeColors() {
  cv::Mat ramp(1, 256, CV_8UC1), colors;
  for (int i = 0; i < ramp.cols; ++i) ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, colors, cv::COLORMAP_VIRIDIS);
  return colors;
}

/// Returns the color of a share of the scale of ages, 0 to 1.
cv::Scalar ColorOf(double share) {
  static const cv::Mat kColors = MakeColors();
  const int index = kDarkest + static_cast<int>(std::lround((255 - kDarkest) * share));
  return kColors.at<cv::Vec3b>(std::clamp(index, kDarkest, 255));
}

double ShareOfScale(int age) { return std::log2(std::clamp(age, 1, kMaxAge)) / std::log2(kMaxAge); }

cv::Point Fixed(const cv::Point2f& pixel) {
  return {static_cast<int>(std::lround(pixel.x * (1 << kSubpixelBits))),
          static_cast<int>(std::lround(pixel.y * (1 << kSubpixelBits)))};
}

void Tint(const cv::Mat& mask, cv::Mat& drawing) {
  if (mask.empty()) return;
  const cv::Mat color(drawing.size(), drawing.type(), kTint);
  cv::Mat tinted;
  cv::addWeighted(drawing, 1 - kTintShare, color, kTintShare, 0, tinted);
  tinted.copyTo(drawing, mask == 0);
}

void DrawTrack(const Track& track, double unit, cv::Mat& drawing) {
  const cv::Scalar color = ColorOf(ShareOfScale(track.age));
  std::vector<cv::Point> pixels;
  for (const cv::Point2f& pixel : track.pixels) pixels.push_back(Fixed(pixel));
  const int thickness = std::max(1, static_cast<int>(std::lround(unit)));
  cv::polylines(drawing, pixels, false, color, thickness, cv::LINE_AA, kSubpixelBits);
  const int radius = static_cast<int>(std::lround(2.8 * unit * (1 << kSubpixelBits)));
  const int outline = radius + static_cast<int>(std::lround(unit * (1 << kSubpixelBits)));
  cv::circle(drawing, pixels.back(), outline, kOutline, -1, cv::LINE_AA, kSubpixelBits);
  cv::circle(drawing, pixels.back(), radius, color, -1, cv::LINE_AA, kSubpixelBits);
}

/// A line of text in an image.
class CaptionLine {
 public:
  CaptionLine(double unit, int baseline, cv::Mat& image)
      : scale_(0.5 * unit),
        thickness_(std::max(1, static_cast<int>(std::lround(unit)))),
        baseline_(baseline),
        image_(image) {}

  int WidthOf(const std::string& text) const {
    return cv::getTextSize(text, kFont, scale_, thickness_, nullptr).width;
  }
  /// Writes a text from column `x`, smaller if it is wider than `width`. Returns its right end.
  int Write(const std::string& text, int x, int width, const cv::Scalar& color) const {
    const double shrink = std::min(1.0, static_cast<double>(width) / std::max(1, WidthOf(text)));
    cv::putText(image_, text, {x, baseline_}, kFont, shrink * scale_, color, thickness_,
                cv::LINE_AA);
    return x + static_cast<int>(shrink * WidthOf(text));
  }

 private:
  double scale_;
  int thickness_;
  int baseline_;
  cv::Mat& image_;
};

/// Draws the colors of ages at the right end of a bar. Returns the column at which they start.
int DrawLegend(double unit, const cv::Rect& row, const CaptionLine& line, cv::Mat& bar) {
  const int gap = static_cast<int>(6 * unit), length = static_cast<int>(90 * unit);
  const std::string young = "tracked 1", old = fmt::format("{}+ frames", kMaxAge);
  int x = row.x + row.width - gap - line.WidthOf(old);
  line.Write(old, x, line.WidthOf(old), kMinorText);
  x -= gap + length;
  const int top = row.y + row.height * 3 / 10, bottom = row.y + row.height * 7 / 10;
  for (int i = 0; i < length; ++i) {
    cv::line(bar, {x + i, top}, {x + i, bottom}, ColorOf(static_cast<double>(i) / length));
  }
  x -= gap + line.WidthOf(young);
  line.Write(young, x, line.WidthOf(young), kMinorText);
  return x - gap;
}

/// Writes the state and, if there is room, what its reason means. `right` is the last column.
void WriteState(const FrameResult& result, const CaptionLine& line, int left, int right) {
  const bool has_reason = result.reason != Reason::kNone;
  const std::string state = StateText(result);
  const int end =
      line.Write(state, left, std::max(1, right - left), has_reason ? kReasonText : kText);
  const std::string advice = fmt::format("  ({})", Advice(result.reason));
  if (!has_reason || end + line.WidthOf(advice) > right) return;
  line.Write(advice, end, right - end, kMinorText);
}

std::string Words(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

}  // namespace

std::string StateText(const FrameResult& result) {
  std::string text = Words(ToString(result.state));
  const std::string reason = Words(ToString(result.reason));
  if (result.reason != Reason::kNone && reason != text) text += ": " + reason;
  if (IsMissingImage(result.reason) || result.num_matches == 0) return text;
  const bool has_map = result.state == State::kTracking || result.state == State::kLost;
  return text + fmt::format(", {} of {} {}", result.num_inliers, result.num_matches,
                            has_map ? "landmarks" : "matches");
}

cv::Mat DrawTracks(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                   const TrackHistory& tracks) {
  cv::Mat drawing;
  cv::cvtColor(image, drawing, cv::COLOR_GRAY2BGR);
  Tint(mask, drawing);
  const double unit = UnitOf(image);
  for (int i = 0; i < frame.num_keypoints(); ++i) {
    if (frame.landmarks[i] != kNoId) continue;
    cv::circle(drawing, PixelOf(frame, i), static_cast<int>(std::lround(unit)), kUntracked, -1);
  }
  for (const LandmarkId landmark : frame.landmarks) {
    if (landmark != kNoId) DrawTrack(tracks.Of(landmark), unit, drawing);
  }
  return drawing;
}

cv::Mat WithCaption(const cv::Mat& image, const FrameResult& result) {
  const double unit = UnitOf(image);
  const int height = static_cast<int>(std::lround(26 * unit));
  const bool has_two_rows = image.cols < 850 * unit;
  cv::Mat bar((has_two_rows ? 2 : 1) * height, image.cols, CV_8UC3, kBar);
  const int gap = static_cast<int>(6 * unit);
  const CaptionLine first(unit, height * 7 / 10, bar), last(unit, bar.rows - height * 3 / 10, bar);
  const int end = DrawLegend(unit, {0, bar.rows - height, bar.cols, height}, last, bar);
  const int left =
      last.Write(fmt::format("frame {}", result.index), gap, std::max(1, end - gap), kMinorText);
  if (has_two_rows) {
    WriteState(result, first, gap, image.cols - gap);
  } else {
    WriteState(result, first, left + 3 * gap, end - gap);
  }
  cv::Mat captioned;
  cv::vconcat(image, bar, captioned);
  return captioned;
}

}  // namespace corvo
