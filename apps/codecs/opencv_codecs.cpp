// SPDX-License-Identifier: MIT
#include "apps/codecs/opencv_codecs.h"

#include <opencv2/videoio.hpp>

#include "apps/codecs/image_codecs.h"
#include "apps/codecs/orientation.h"

namespace corvo {
namespace {

int ToOpenCv(VideoBackend backend) {
  return backend == VideoBackend::kFfmpeg ? cv::CAP_FFMPEG : cv::CAP_OPENCV_MJPEG;
}

int ToOpenCv(VideoProperty property) {
  switch (property) {
    case VideoProperty::kWidth:
      return cv::CAP_PROP_FRAME_WIDTH;
    case VideoProperty::kHeight:
      return cv::CAP_PROP_FRAME_HEIGHT;
    case VideoProperty::kNumFrames:
      return cv::CAP_PROP_FRAME_COUNT;
    case VideoProperty::kFrameRateHz:
      return cv::CAP_PROP_FPS;
    case VideoProperty::kTimeMs:
      return cv::CAP_PROP_POS_MSEC;
    case VideoProperty::kClockwiseDeg:
      return cv::CAP_PROP_ORIENTATION_META;
  }
  return -1;
}

/// Returns the code of a backend's codec. Both encoders are parts of OpenCV and FFmpeg under their
/// own, permissive or LGPL licenses, unlike x264.
int CodecOf(VideoBackend backend) {
  return backend == VideoBackend::kFfmpeg ? cv::VideoWriter::fourcc('m', 'p', '4', 'v')
                                          : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
}

class CaptureInput : public VideoInput {
 public:
  explicit CaptureInput(const cv::VideoCapture& capture) : capture_(capture) {}

  bool Grab() override { return capture_.grab(); }
  bool Retrieve(cv::Mat& image) override { return capture_.retrieve(image); }
  double Get(VideoProperty property) const override {
    const double value = capture_.get(ToOpenCv(property));
    if (property != VideoProperty::kClockwiseDeg) return value;
    return ClockwiseDegrees(static_cast<int>(value), cv::getVersionMajor(), cv::getVersionMinor());
  }

 private:
  cv::VideoCapture capture_;
};

class WriterOutput : public VideoOutput {
 public:
  explicit WriterOutput(const cv::VideoWriter& writer) : writer_(writer) {}

  void Write(const cv::Mat& image) override { writer_.write(image); }

 private:
  cv::VideoWriter writer_;
};

/// Copies of a capture share its state.
std::unique_ptr<VideoInput> ToInput(const cv::VideoCapture& capture) {
  if (!capture.isOpened()) return nullptr;
  return std::make_unique<CaptureInput>(capture);
}

/// Returns null on errors. `parameters` are pairs of a property and its value.
std::unique_ptr<VideoInput> Open(const std::string& file, VideoBackend backend,
                                 const std::vector<int>& parameters) {
  try {
    cv::VideoCapture capture(file, ToOpenCv(backend), parameters);
    capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // Its default depends on the version.
    return ToInput(capture);
  } catch (const cv::Exception&) {
    return nullptr;
  }
}

class AllCodecs : public ImageCodecs {
 public:
  std::unique_ptr<VideoInput> OpenVideo(const std::string& file,
                                        VideoBackend backend) const override {
    return Open(file, backend, {});
  }

  std::unique_ptr<VideoInput> OpenPackets(const std::string& file) const override {
    return Open(file, VideoBackend::kFfmpeg, {cv::CAP_PROP_FORMAT, -1});
  }

  std::unique_ptr<VideoInput> OpenCamera(int device) const override {
    try {
      return ToInput(cv::VideoCapture(device, cv::CAP_V4L2));
    } catch (const cv::Exception&) {
      return nullptr;
    }
  }

  std::unique_ptr<VideoOutput> CreateVideo(const std::string& file,
                                           const VideoFormat& format) const override {
    try {
      cv::VideoWriter writer(file, ToOpenCv(format.backend), CodecOf(format.backend),
                             format.frame_rate_hz, format.size);
      if (!writer.isOpened()) return nullptr;
      return std::make_unique<WriterOutput>(writer);
    } catch (const cv::Exception&) {
      return nullptr;
    }
  }
};

}  // namespace

const Codecs& OpenCvCodecs() {
  static const AllCodecs codecs;
  return codecs;
}

}  // namespace corvo
