// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo {

/// The backend of OpenCV that reads or writes a video.
enum class VideoBackend { kFfmpeg, kMotionJpeg };

/// What a video or camera says of itself.
enum class VideoProperty {
  kWidth,      ///< px, as the images are stored.
  kHeight,     ///< px, as the images are stored.
  kNumFrames,  ///< May be an estimate.
  kFrameRateHz,
  kTimeMs,        ///< Time of the grabbed frame.
  kClockwiseDeg,  ///< By how much images are to be turned clockwise.
};

/// A video or connected camera that is read frame by frame, as by cv::VideoCapture.
class VideoInput {
 public:
  virtual ~VideoInput() = default;
  /// Goes on to the next frame without decoding it. Returns false at the end and on damage.
  virtual bool Grab() = 0;
  /// Decodes the grabbed frame. Returns false if that fails.
  virtual bool Retrieve(cv::Mat& image) = 0;
  /// Returns 0 if the property is unknown.
  virtual double Get(VideoProperty property) const = 0;
};

/// A video that is written frame by frame, as by cv::VideoWriter, and completed by its destructor.
class VideoOutput {
 public:
  virtual ~VideoOutput() = default;
  virtual void Write(const cv::Mat& image) = 0;
};

/// The format of a video that is written: MPEG-4 by FFmpeg, or Motion JPEG.
struct VideoFormat {
  VideoBackend backend = VideoBackend::kFfmpeg;
  double frame_rate_hz = 30;
  cv::Size size;
};

/// What OpenCV reads and writes by way of some 200 shared libraries. They are loaded when it is
/// first needed, so that the command starts at once.
class Codecs {
 public:
  virtual ~Codecs() = default;

  /// Like cv::imdecode(). Returns an empty image on errors.
  virtual cv::Mat DecodeImage(const std::string& bytes, int flags) const = 0;
  /// Like cv::imencode(). Returns an empty vector on errors.
  virtual std::vector<std::uint8_t> EncodeImage(const std::string& extension,
                                                const cv::Mat& image) const = 0;
  /// Opens a video. Returns null on errors.
  virtual std::unique_ptr<VideoInput> OpenVideo(const std::string& file,
                                                VideoBackend backend) const = 0;
  /// Opens a video whose images are its encoded packets, rows of bytes. Returns null on errors.
  virtual std::unique_ptr<VideoInput> OpenPackets(const std::string& file) const = 0;
  /// Opens a connected camera. Returns null on errors.
  virtual std::unique_ptr<VideoInput> OpenCamera(int device) const = 0;
  /// Begins a video. Returns null on errors.
  virtual std::unique_ptr<VideoOutput> CreateVideo(const std::string& file,
                                                   const VideoFormat& format) const = 0;
};

/// Returns the codecs, which the program that links corvo_apps defines: corvo_codecs, what the
/// command loads with the first call, or those of the Python package. Throws corvo::Error if they
/// cannot be loaded.
const Codecs& GetCodecs();

}  // namespace corvo
