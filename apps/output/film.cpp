// SPDX-License-Identifier: MIT
#include "apps/output/film.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <opencv2/core.hpp>

#include "apps/output/file_extension.h"
#include "apps/system/decoder_messages.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNumWaiting = 12;  // Drawings whose timestamps give the frame rate.

/// Returns OpenCV's own backend for Motion JPEG, or FFmpeg.
VideoBackend BackendOf(const fs::path& file) {
  return LowerExtension(file) == ".avi" ? VideoBackend::kMotionJpeg : VideoBackend::kFfmpeg;
}

/// Opens a film; returns null on errors.
std::unique_ptr<VideoOutput> Open(const fs::path& file, double frame_rate_hz,
                                  const cv::Size& size) {
  const Codecs& codecs = GetCodecs();
  const DecoderMessages messages;
  return codecs.CreateVideo(file.string(), {BackendOf(file), frame_rate_hz, size});
}

/// Throws corvo::Error if OpenCV has no encoder for the file, which need not exist.
void CheckEncoder(const fs::path& staged, const fs::path& file) {
  const bool is_opened = Open(staged, 30, {64, 64}) != nullptr;
  std::error_code ignored;
  fs::remove(staged, ignored);
  if (is_opened) return;
  throw Error(
      fmt::format("{}: cannot be written: this OpenCV has no encoder for it; give the name "
                  "of a folder instead",
                  file.string()));
}

/// Returns whether a film can be opened and has the number of images. OpenCV does not report errors
/// of writing.
bool IsWhole(const fs::path& file, int num_images) {
  const DecoderMessages messages;
  const std::unique_ptr<VideoInput> film = GetCodecs().OpenVideo(file.string(), BackendOf(file));
  return film && std::lround(film->Get(VideoProperty::kNumFrames)) >= num_images;
}

/// Returns the image with an even number of rows and columns, which MPEG-4 needs.
cv::Mat WithEvenSize(const cv::Mat& image) {
  cv::Mat even(image.rows + image.rows % 2, image.cols + image.cols % 2, image.type(),
               cv::Scalar::all(0));
  image.copyTo(even(cv::Rect(0, 0, image.cols, image.rows)));
  return even;
}

}  // namespace

bool IsFilmName(const fs::path& file) {
  constexpr std::array<const char*, 4> kFilms = {".mp4", ".mov", ".mkv", ".avi"};
  constexpr std::array<const char*, 8> kOthers = {".webm", ".m4v", ".mpg", ".mpeg",
                                                  ".wmv",  ".gif", ".flv", ".ogv"};
  const std::string extension = LowerExtension(file);
  if (std::ranges::count(kOthers, extension) > 0) {
    throw Error(fmt::format(
        "--draw: {}: the extension is \"{}\"; allowed is .mp4, .mov, .mkv or .avi for a film, or "
        "the name of a folder",
        file.string(), file.extension().string()));
  }
  return std::ranges::count(kFilms, extension) > 0;
}

double FilmFrameRate(const std::vector<TimeNs>& times) {
  constexpr double kDefault_hz = 30, kMin_hz = 1, kMax_hz = 240;
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < times.size(); ++i) {
    steps_s.push_back(1e-9 * static_cast<double>(times[i] - times[i - 1]));
  }
  if (steps_s.empty()) return kDefault_hz;
  const auto median = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), median, steps_s.end());
  const double rate_hz = std::clamp(1 / std::max(*median, 1e-9), kMin_hz, kMax_hz);
  return std::round(100 * rate_hz) / 100;  // MPEG-4 has 16 bits for the unit of time.
}

Film::Film(const fs::path& file, bool replaces_foreign)
    : file_(file),
      output_(fs::absolute(file).parent_path(), PlanOfFile(file, {}, replaces_foreign)),
      staged_(output_.Stage(file.filename().string())) {
  CheckEncoder(staged_, file_);
}

void Film::Add(const cv::Mat& drawing, const FrameResult& frame) {
  if (writer_) {
    Write(drawing);
    return;
  }
  waiting_.emplace_back(frame.time_ns, drawing.clone());
  if (waiting_.size() == kNumWaiting) Start();
}

void Film::Start() {
  std::vector<TimeNs> times;
  for (const auto& [time_ns, drawing] : waiting_) times.push_back(time_ns);
  writer_ = Open(staged_, FilmFrameRate(times), WithEvenSize(waiting_.front().second).size());
  if (!writer_) throw Error(fmt::format("{}: cannot be written", file_.string()));
  for (const auto& [time_ns, drawing] : waiting_) Write(drawing);
  waiting_.clear();
}

void Film::Write(const cv::Mat& drawing) {
  writer_->Write(WithEvenSize(drawing));
  ++num_written_;
}

void Film::Finish(bool is_complete) {
  if (!waiting_.empty()) Start();
  if (num_written_ == 0) return;
  {
    const DecoderMessages messages;
    writer_.reset();
  }
  if (!is_complete && output_.HoldsCompleteResult()) {
    spdlog::warn("{} was not replaced: it shows a complete run", file_.string());
    return;
  }
  if (!IsWhole(staged_, num_written_)) {
    throw Error(fmt::format("{}: cannot be written in full", file_.string()));
  }
  output_.Commit(is_complete);
}

}  // namespace corvo
