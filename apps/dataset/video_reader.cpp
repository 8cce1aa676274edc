// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <opencv2/videoio.hpp>

#include "apps/dataset/decoder_messages.h"
#include "apps/dataset/image_header.h"
#include "apps/dataset/image_reader.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr double kDefaultFrameRateHz = 30.0;  // For videos without a frame rate.

/// The base of video and camera readers. Frames are grabbed in order, and decoded only by Read().
class CaptureReader : public ImageReader {
 public:
  CaptureReader(const cv::VideoCapture& capture, std::string name)
      : capture_(capture), name_(std::move(name)) {}

  std::optional<TimedImage> Read() override {
    if (!Skip()) return std::nullopt;
    const std::string name = fmt::format("{}, frame {}", name_, index_);
    cv::Mat image;
    if (!Retrieve(image)) {
      return TimedImage{{},
                        {},
                        time_ns_,
                        index_,
                        name,
                        Reason::kUnreadableImage,
                        fmt::format("{}: cannot be decoded", name)};
    }
    return TimedImage{
        ToGray(image, name).clone(), {}, time_ns_, index_, name, Reason::kNone, {}, image};
  }

  bool Skip() override {
    if (!Grab()) return false;
    ++index_;
    time_ns_ = TimeOfGrabbed(capture_, index_, time_ns_);
    return true;
  }

 private:
  bool Grab() {
    DecoderMessages messages;
    const bool is_grabbed = capture_.grab();
    KeepComplaint(messages.Take());
    return is_grabbed;
  }

  bool Retrieve(cv::Mat& image) {
    bool is_retrieved = false;
    {
      DecoderMessages messages;
      is_retrieved = capture_.retrieve(image);
      KeepComplaint(messages.Take());
    }
    if (!complaint_.empty() && !has_complained_) {
      spdlog::warn("{}, frame {}: the decoder says: {}", name_, index_, complaint_);
      has_complained_ = true;
    }
    return is_retrieved;
  }

  void KeepComplaint(const std::string& complaint) {
    if (complaint_.empty()) complaint_ = complaint;
  }

  /// Returns the timestamp of the grabbed frame. `before` is the timestamp of the previous frame;
  /// it is ignored for the first.
  virtual TimeNs TimeOfGrabbed(cv::VideoCapture& capture, int index, TimeNs before) = 0;

  cv::VideoCapture capture_;
  std::string name_;
  std::string complaint_;        ///< The first message of the decoder.
  bool has_complained_ = false;  ///< Whether it was logged.
  int index_ = -1;
  TimeNs time_ns_ = 0;
};

class VideoReader : public CaptureReader {
 public:
  VideoReader(const cv::VideoCapture& capture, const std::string& name,
              std::optional<double> frame_rate_hz)
      : CaptureReader(capture, name), frame_rate_hz_(frame_rate_hz) {
    const double said_hz = capture.get(cv::CAP_PROP_FPS);
    const bool is_plausible = said_hz >= 1e-3 && said_hz <= 1e6;
    frame_ns_ = std::llround(1e9 / (is_plausible ? said_hz : kDefaultFrameRateHz));
  }

 private:
  TimeNs TimeOfGrabbed(cv::VideoCapture& capture, int index, TimeNs before) override {
    if (frame_rate_hz_) return std::llround(1e9 * index / *frame_rate_hz_);
    const double said_ms = capture.get(cv::CAP_PROP_POS_MSEC);
    const TimeNs time_ns = std::isfinite(said_ms) ? std::llround(1e6 * said_ms) : 0;
    return index == 0 || time_ns > before ? time_ns : before + frame_ns_;
  }

  std::optional<double> frame_rate_hz_;
  TimeNs frame_ns_ = 0;
};

class CameraReader : public CaptureReader {
 public:
  using CaptureReader::CaptureReader;

 private:
  TimeNs TimeOfGrabbed(cv::VideoCapture&, int index, TimeNs before) override {
    const TimeNs time_ns = std::chrono::nanoseconds(Clock::now() - opened_).count();
    return index == 0 ? time_ns : std::max(time_ns, before + 1);
  }

  using Clock = std::chrono::steady_clock;
  Clock::time_point opened_ = Clock::now();
};

/// Opens a capture with a fixed backend, so that timestamps and colors do not depend on the
/// installed backends. Returns an unopened capture on errors.
template <typename Source>
cv::VideoCapture OpenCapture(const Source& source, int backend) {
  try {
    return cv::VideoCapture(source, backend);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

std::unique_ptr<ImageReader> OpenVideo(const fs::path& file, std::optional<double> frame_rate_hz) {
  DecoderMessages messages;
  const cv::VideoCapture capture = OpenCapture(file.string(), cv::CAP_FFMPEG);
  if (!capture.isOpened()) {
    const std::string complaint = messages.Take();
    throw Error(fmt::format("{}: neither a folder of images nor a video that can be decoded{}",
                            file.string(), complaint.empty() ? "" : " (" + complaint + ")"));
  }
  CheckRange(file.string() + ": number of pixels",
             capture.get(cv::CAP_PROP_FRAME_WIDTH) * capture.get(cv::CAP_PROP_FRAME_HEIGHT), 0.0,
             static_cast<double>(kMaxImagePixels));
  return std::make_unique<VideoReader>(capture, file.string(), frame_rate_hz);
}

std::unique_ptr<ImageReader> OpenCamera(int device) {
  const std::string name = fmt::format("camera:{}", device);
  const cv::VideoCapture capture = OpenCapture(device, cv::CAP_V4L2);
  if (!capture.isOpened()) throw Error(fmt::format("{}: there is no such camera", name));
  return std::make_unique<CameraReader>(capture, name);
}

}  // namespace corvo
