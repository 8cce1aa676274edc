// SPDX-License-Identifier: MIT
#include "apps/codecs/opencv_codecs.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "orb/error.h"

namespace corvo {
namespace {

class CaptureInput : public VideoInput {
 public:
  explicit CaptureInput(const cv::VideoCapture& capture) : capture_(capture) {}

  bool Grab() override { return capture_.grab(); }
  bool Retrieve(cv::Mat& image) override { return capture_.retrieve(image); }
  double Get(int property) const override { return capture_.get(property); }

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

class AllCodecs : public Codecs {
 public:
  cv::Mat DecodeImage(const std::string& bytes, int flags) const override {
    try {
      const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1,
                           const_cast<char*>(bytes.data()));
      return cv::imdecode(buffer, flags);
    } catch (const cv::Exception&) {
      return {};
    }
  }

  std::vector<std::uint8_t> EncodeImage(const std::string& extension,
                                        const cv::Mat& image) const override {
    std::vector<std::uint8_t> bytes;
    try {
      if (!cv::imencode(extension, image, bytes)) bytes.clear();
    } catch (const cv::Exception&) {
      bytes.clear();
    }
    return bytes;
  }

  std::unique_ptr<VideoInput> OpenVideo(const std::string& file, int backend,
                                        const std::vector<int>& parameters) const override {
    try {
      cv::VideoCapture capture(file, backend, parameters);
      capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // Its default depends on the version.
      return ToInput(capture);
    } catch (const cv::Exception&) {
      return nullptr;
    }
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
      cv::VideoWriter writer(file, format.backend, format.codec, format.frame_rate_hz, format.size);
      if (!writer.isOpened()) return nullptr;
      return std::make_unique<WriterOutput>(writer);
    } catch (const cv::Exception&) {
      return nullptr;
    }
  }

  std::unique_ptr<BagInput> OpenBag(const std::string& bag,
                                    const std::string& /*topic*/) const override {
    throw Error(bag + ": is a ROS bag, which the Python package reads: pip install 'corvo[bags]'");
  }
};

}  // namespace

const Codecs& OpenCvCodecs() {
  static const AllCodecs codecs;
  return codecs;
}

}  // namespace corvo
