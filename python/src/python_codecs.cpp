// SPDX-License-Identifier: MIT
// The codecs of the package: images by OpenCV's imgcodecs, videos by the Python package of OpenCV,
// cv2, if it is installed.
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include "apps/codecs/image_codecs.h"
#include "apps/codecs/orientation.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace nb = nanobind;

using PixelArray = nb::ndarray<nb::ro, nb::device::cpu, nb::c_contig>;

/// Returns the module cv2. Throws corvo::Error if it is not installed. The GIL must be held.
nb::module_ ImportCv2(const std::string& input) {
  try {
    return nb::module_::import_("cv2");
  } catch (const nb::python_error&) {
    throw Error(
        fmt::format("{}: videos and cameras are read and written with OpenCV's Python "
                    "package, which is not installed: pip install corvo[video]",
                    input));
  }
}

const char* NameOf(VideoProperty property) {
  switch (property) {
    case VideoProperty::kWidth:
      return "CAP_PROP_FRAME_WIDTH";
    case VideoProperty::kHeight:
      return "CAP_PROP_FRAME_HEIGHT";
    case VideoProperty::kNumFrames:
      return "CAP_PROP_FRAME_COUNT";
    case VideoProperty::kFrameRateHz:
      return "CAP_PROP_FPS";
    case VideoProperty::kTimeMs:
      return "CAP_PROP_POS_MSEC";
    case VideoProperty::kClockwiseDeg:
      return "CAP_PROP_ORIENTATION_META";
  }
  return "";
}

const char* NameOf(VideoBackend backend) {
  return backend == VideoBackend::kFfmpeg ? "CAP_FFMPEG" : "CAP_OPENCV_MJPEG";
}

/// Returns a copy of an array of bytes: of one or three channels, or a row of them.
cv::Mat ToMat(nb::handle object) {
  const auto array = nb::cast<PixelArray>(object);
  const int type = array.ndim() == 3 ? CV_8UC(static_cast<int>(array.shape(2))) : CV_8UC1;
  const int rows = static_cast<int>(array.shape(0));
  const int columns = array.ndim() == 1 ? 1 : static_cast<int>(array.shape(1));
  cv::Mat image(rows, columns, type);
  std::memcpy(image.data, array.data(), array.nbytes());
  return image;
}

/// Calls `work` with the GIL. Returns `otherwise` if Python raises an exception.
template <typename Result, typename Work>
Result WithGil(Result otherwise, Work&& work) {
  const nb::gil_scoped_acquire acquire;
  try {
    return work();
  } catch (const nb::python_error&) {
    return otherwise;
  }
}

/// A Python object that is released with the GIL.
class Owned {
 public:
  explicit Owned(nb::object object) : object_(std::move(object)) {}
  ~Owned() {
    const nb::gil_scoped_acquire acquire;
    object_.reset();
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;

  const nb::object& get() const { return object_; }

 private:
  nb::object object_;
};

class Cv2Input : public VideoInput {
 public:
  explicit Cv2Input(nb::object capture) : capture_(std::move(capture)) {}

  bool Grab() override {
    return WithGil(false, [&] { return nb::cast<bool>(capture_.get().attr("grab")()); });
  }

  bool Retrieve(cv::Mat& image) override {
    return WithGil(false, [&] {
      const nb::object result = capture_.get().attr("retrieve")();
      if (!nb::cast<bool>(result[0])) return false;
      image = ToMat(result[1]);
      return true;
    });
  }

  double Get(VideoProperty property) const override {
    return WithGil(0.0, [&] {
      const nb::module_ cv2 = nb::module_::import_("cv2");
      const auto value = nb::cast<double>(capture_.get().attr("get")(cv2.attr(NameOf(property))));
      if (property != VideoProperty::kClockwiseDeg) return value;
      return static_cast<double>(ClockwiseDegrees(static_cast<int>(value),
                                                  nb::cast<int>(cv2.attr("getVersionMajor")()),
                                                  nb::cast<int>(cv2.attr("getVersionMinor")())));
    });
  }

 private:
  Owned capture_;
};

class Cv2Output : public VideoOutput {
 public:
  explicit Cv2Output(nb::object writer) : writer_(std::move(writer)) {}
  ~Cv2Output() override {
    WithGil(false, [&] {
      writer_.get().attr("release")();
      return true;
    });
  }

  void Write(const cv::Mat& image) override {
    WithGil(false, [&] {
      const cv::Mat pixels = image.isContinuous() ? image : image.clone();
      const nb::ndarray<nb::numpy, const std::uint8_t, nb::ndim<3>> array(
          pixels.data,
          {static_cast<std::size_t>(pixels.rows), static_cast<std::size_t>(pixels.cols),
           static_cast<std::size_t>(pixels.channels())});
      writer_.get().attr("write")(nb::cast(array, nb::rv_policy::copy));
      return true;
    });
  }

 private:
  Owned writer_;
};

/// Returns null unless the capture or writer is opened.
template <typename Opened>
std::unique_ptr<Opened> IfOpened(nb::object object) {
  if (!nb::cast<bool>(object.attr("isOpened")())) return nullptr;
  return std::make_unique<Opened>(std::move(object));
}

class Cv2Codecs : public ImageCodecs {
 public:
  std::unique_ptr<VideoInput> OpenVideo(const std::string& file,
                                        VideoBackend backend) const override {
    return Open(file, backend, [](const nb::module_&) { return nb::list(); });
  }

  std::unique_ptr<VideoInput> OpenPackets(const std::string& file) const override {
    return Open(file, VideoBackend::kFfmpeg, [](const nb::module_& cv2) {
      nb::list parameters;
      parameters.append(cv2.attr("CAP_PROP_FORMAT"));
      parameters.append(-1);
      return parameters;
    });
  }

  std::unique_ptr<VideoInput> OpenCamera(int device) const override {
    return WithGil(std::unique_ptr<VideoInput>(), [&]() -> std::unique_ptr<VideoInput> {
      const nb::module_ cv2 = ImportCv2(fmt::format("camera:{}", device));
      return IfOpened<Cv2Input>(cv2.attr("VideoCapture")(device, cv2.attr("CAP_V4L2")));
    });
  }

  std::unique_ptr<VideoOutput> CreateVideo(const std::string& file,
                                           const VideoFormat& format) const override {
    return WithGil(std::unique_ptr<VideoOutput>(), [&]() -> std::unique_ptr<VideoOutput> {
      const nb::module_ cv2 = ImportCv2(file);
      const nb::object codec =
          cv2.attr("VideoWriter")
              .attr("fourcc")(
                  *nb::tuple(nb::str(format.backend == VideoBackend::kFfmpeg ? "mp4v" : "MJPG")));
      return IfOpened<Cv2Output>(cv2.attr("VideoWriter")(
          file, cv2.attr(NameOf(format.backend)), codec, format.frame_rate_hz,
          nb::make_tuple(format.size.width, format.size.height)));
    });
  }

 private:
  /// `parameters_of` returns pairs of a property and its value.
  template <typename ParametersOf>
  static std::unique_ptr<VideoInput> Open(const std::string& file, VideoBackend backend,
                                          ParametersOf&& parameters_of) {
    return WithGil(std::unique_ptr<VideoInput>(), [&]() -> std::unique_ptr<VideoInput> {
      const nb::module_ cv2 = ImportCv2(file);
      const nb::object capture =
          cv2.attr("VideoCapture")(file, cv2.attr(NameOf(backend)), parameters_of(cv2));
      capture.attr("set")(cv2.attr("CAP_PROP_ORIENTATION_AUTO"), 0);
      return IfOpened<Cv2Input>(capture);
    });
  }
};

}  // namespace

const Codecs& GetCodecs() {
  static const Cv2Codecs codecs;
  return codecs;
}

}  // namespace corvo
