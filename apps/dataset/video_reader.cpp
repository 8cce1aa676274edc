// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <opencv2/core.hpp>

#include "apps/codecs/codecs.h"
#include "apps/dataset/image_header.h"
#include "apps/dataset/image_reader.h"
#include "apps/dataset/packet_size.h"
#include "apps/output/log_once.h"
#include "apps/system/decoder_messages.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr double kDefaultFrameRateHz = 30.0;  // For videos without a frame rate.
constexpr int kMaxDamagedInARow = 1000;

/// The base of video and camera readers. Frames are grabbed in order, and decoded only by Read().
class CaptureReader : public ImageReader {
 public:
  CaptureReader(std::unique_ptr<VideoInput> input, std::string name)
      : input_(std::move(input)), name_(std::move(name)) {}

  std::optional<TimedImage> Read() override {
    if (!Skip()) return std::nullopt;
    TimedImage read{{}, {}, time_ns_, index_, fmt::format("{}, frame {}", name_, index_)};
    cv::Mat image;
    read.missing = Retrieve(image);
    if (read.missing == Reason::kNone) {
      read.color = Upright(image);
      read.image = ToGray(read.color, read.name).clone();
    } else if (read.missing == Reason::kWrongSize) {
      read.error = fmt::format("{}: the image has another size than the first", read.name);
    } else {
      read.error = fmt::format("{}: cannot be decoded", read.name);
    }
    return read;
  }

  /// The capture reports damage like the end; only another attempt tells them apart.
  bool Skip() override {
    if (!input_) return false;
    const int max_damaged = std::min(frames_.num_promised - index_ - 2, kMaxDamagedInARow);
    int num_damaged = 0;
    while (!Grab()) {
      if (++num_damaged <= max_damaged || TakeUpAgain()) continue;
      frames_.is_cut_off = IsCutOff(frames_, !complaint_.empty());
      return false;
    }
    frames_.num_damaged += num_damaged;
    ++frames_.num_read;
    index_ += num_damaged + 1;
    time_ns_ = TimeOfGrabbed(*input_, index_, time_ns_);
    return true;
  }

 protected:
  const VideoInput& input() const { return *input_; }
  /// Null closes the input; another one is then set before the next image is grabbed.
  void SetInput(std::unique_ptr<VideoInput> input) { input_ = std::move(input); }
  const std::string& name() const { return name_; }

  VideoFrames frames_;

 private:
  bool Grab() {
    DecoderMessages messages;
    const bool is_grabbed = input_->Grab();
    has_other_size_ = HasOtherSize();
    KeepComplaint(messages.Take());
    return is_grabbed;
  }

  /// Returns why there is no image of the grabbed frame, or Reason::kNone.
  Reason Retrieve(cv::Mat& image) {
    if (has_other_size_) return Reason::kWrongSize;
    bool is_retrieved = false;
    std::string complaint;
    {
      DecoderMessages messages;
      is_retrieved = input_->Retrieve(image);
      complaint = messages.Take();
    }
    // FFmpeg's scaler says so of an image that is higher than the first.
    if (complaint.find("Slice parameters") != std::string::npos) return Reason::kWrongSize;
    KeepComplaint(complaint);
    if (!complaint_.empty()) {
      LogOnce(spdlog::level::warn,
              fmt::format("{}, frame {}: the decoder says: {}", name_, index_, complaint_), name_);
    }
    return is_retrieved ? Reason::kNone : Reason::kUnreadableImage;
  }

  void KeepComplaint(const std::string& complaint) {
    if (complaint_.empty()) complaint_ = complaint;
  }

  /// Returns the timestamp of the grabbed frame. `before` is the timestamp of the previous frame;
  /// it is ignored for the first.
  virtual TimeNs TimeOfGrabbed(const VideoInput& input, int index, TimeNs before) = 0;
  /// Returns whether the last frames are missing. `has_errors` tells whether the decoder
  /// complained.
  virtual bool IsCutOff(const VideoFrames&, bool /*has_errors*/) const { return false; }
  /// Opens an input that has ended again. Returns false if that is not its end.
  virtual bool TakeUpAgain() { return false; }
  /// Returns whether the grabbed frame is known to have another size than the first.
  virtual bool HasOtherSize() { return false; }
  /// Returns a copy of an image, turned as it was taken.
  virtual cv::Mat Upright(const cv::Mat& image) const { return image.clone(); }

  std::unique_ptr<VideoInput> input_;
  std::string name_;
  std::string complaint_;  ///< The first message of the decoder.
  bool has_other_size_ = false;
  int index_ = -1;
  TimeNs time_ns_ = 0;
};

class VideoReader : public CaptureReader {
 public:
  VideoReader(std::unique_ptr<VideoInput> opened, const fs::path& file,
              std::optional<double> frame_rate_hz)
      : CaptureReader(std::move(opened), file.string()),
        packets_(file),
        size_(static_cast<int>(input().Get(VideoProperty::kWidth)),
              static_cast<int>(input().Get(VideoProperty::kHeight))),
        frame_rate_hz_(frame_rate_hz),
        clockwise_deg_(static_cast<int>(input().Get(VideoProperty::kClockwiseDeg))) {
    constexpr double kMaxFrames = 1e9;
    frames_.num_promised =
        static_cast<int>(std::clamp(input().Get(VideoProperty::kNumFrames), 0.0, kMaxFrames));
    const double said_hz = input().Get(VideoProperty::kFrameRateHz);
    const bool is_plausible = said_hz >= 1e-3 && said_hz <= 1e6;
    frame_ns_ = std::llround(1e9 / (is_plausible ? said_hz : kDefaultFrameRateHz));
  }

 private:
  TimeNs TimeOfGrabbed(const VideoInput& input, int index, TimeNs before) override {
    const double said_ms = input.Get(VideoProperty::kTimeMs);
    const TimeNs time_ns = std::isfinite(said_ms) ? std::llround(1e6 * said_ms) : 0;
    last_ns_ = std::max(last_ns_, time_ns);
    if (frame_rate_hz_) return std::llround(1e9 * index / *frame_rate_hz_);
    return index == 0 || time_ns > before ? time_ns : before + frame_ns_;
  }

  cv::Mat Upright(const cv::Mat& image) const override {
    cv::Mat turned;
    switch (clockwise_deg_) {
      case 90:
        cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
        return turned;
      case 180:
        cv::rotate(image, turned, cv::ROTATE_180);
        return turned;
      case 270:
        cv::rotate(image, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
        return turned;
      default:
        return image.clone();
    }
  }

  /// The number of frames may be an estimate from their duration: it counts only together with
  /// errors, or if the duration is too short as well.
  bool IsCutOff(const VideoFrames& frames, bool has_errors) const override {
    constexpr double kMaxMissing = 0.01;
    const int num_missing = frames.num_promised - frames.num_read - frames.num_damaged;
    const auto promised_ns = static_cast<double>(frame_ns_) * frames.num_promised;
    const auto missing_ns = promised_ns - static_cast<double>(last_ns_ + frame_ns_);
    const bool is_short = missing_ns > std::max<double>(frame_ns_, kMaxMissing * promised_ns);
    return num_missing > std::max<double>(1, kMaxMissing * frames.num_promised) &&
           (is_short || has_errors);
  }

  bool HasOtherSize() override {
    const auto size = packets_.Next();
    return size && *size != size_;
  }

  std::optional<VideoFrames> video_frames() const override { return frames_; }

  PacketSizes packets_;
  cv::Size size_;  ///< As the images are stored.
  std::optional<double> frame_rate_hz_;
  int clockwise_deg_ = 0;
  TimeNs frame_ns_ = 0;
  TimeNs last_ns_ = 0;  ///< The last timestamp of the container.
};

class CameraReader : public CaptureReader {
 public:
  using Opener = std::function<std::unique_ptr<VideoInput>()>;

  CameraReader(Opener open, std::unique_ptr<VideoInput> input, std::string name)
      : CaptureReader(std::move(input), std::move(name)), open_(std::move(open)) {}

  void Cancel() override { is_canceled_ = true; }

 private:
  TimeNs TimeOfGrabbed(const VideoInput&, int index, TimeNs before) override {
    has_stopped_ = false;
    const TimeNs time_ns = std::chrono::nanoseconds(Clock::now() - opened_).count();
    return index == 0 ? time_ns : std::max(time_ns, before + 1);
  }

  bool TakeUpAgain() override {
    constexpr std::chrono::milliseconds kPause(100);
    if (frames_.num_read == 0) return false;
    if (!has_stopped_) spdlog::warn("{}: delivers no images; waiting for it", name());
    has_stopped_ = true;
    SetInput(nullptr);  // Many devices can be opened only once at a time.
    while (!is_canceled_) {
      std::this_thread::sleep_for(kPause);
      std::unique_ptr<VideoInput> input = open_();
      if (!input) continue;
      SetInput(std::move(input));
      return true;
    }
    return false;
  }

  using Clock = std::chrono::steady_clock;
  Clock::time_point opened_ = Clock::now();
  Opener open_;
  bool has_stopped_ = false;
  std::atomic<bool> is_canceled_ = false;
};

}  // namespace

std::unique_ptr<ImageReader> OpenVideo(const fs::path& file, std::optional<double> frame_rate_hz) {
  DecoderMessages messages;
  // One backend, so that timestamps and colors do not depend on those that are installed.
  std::unique_ptr<VideoInput> input = GetCodecs().OpenVideo(file.string(), VideoBackend::kFfmpeg);
  if (!input) {
    const std::string complaint = messages.Take();
    throw Error(fmt::format("{}: neither a folder of images nor a video that can be decoded{}",
                            file.string(), complaint.empty() ? "" : " (" + complaint + ")"));
  }
  CheckRange(file.string() + ": number of pixels",
             input->Get(VideoProperty::kWidth) * input->Get(VideoProperty::kHeight), 0.0,
             static_cast<double>(kMaxImagePixels));
  return std::make_unique<VideoReader>(std::move(input), file, frame_rate_hz);
}

std::unique_ptr<ImageReader> OpenCamera(int device) {
  return OpenCamera([device] { return GetCodecs().OpenCamera(device); },
                    fmt::format("camera:{}", device));
}

std::unique_ptr<ImageReader> OpenCamera(std::function<std::unique_ptr<VideoInput>()> open,
                                        const std::string& name) {
  std::unique_ptr<VideoInput> input = open();
  if (!input) throw Error(fmt::format("{}: there is no such camera", name));
  return std::make_unique<CameraReader>(std::move(open), std::move(input), name);
}

}  // namespace corvo
