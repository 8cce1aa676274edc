// SPDX-License-Identifier: MIT
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/images.h"
#include "vo/io/config.h"
#include "vo/odometry.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

/// A frame that was just processed, with its tracks.
struct ProcessedFrame : FrameResult {
  std::vector<double> pixels;           ///< x, y of each keypoint that observes a landmark.
  std::vector<std::int64_t> landmarks;  ///< The landmark that each of them observes.
};

ProcessedFrame WithTracks(FrameResult result, const Frame& frame) {
  ProcessedFrame processed{std::move(result), {}, {}};
  if (!processed.world_from_camera || frame.index != processed.index) return processed;
  for (int i = 0; i < frame.num_keypoints(); ++i) {
    if (frame.landmarks[i] == kNoId) continue;
    processed.pixels.insert(processed.pixels.end(), {frame.pixel(i).x(), frame.pixel(i).y()});
    processed.landmarks.push_back(frame.landmarks[i]);
  }
  return processed;
}

/// An odometry that several Python threads may use: one call at a time works, without the GIL, and
/// others wait for it.
class SharedOdometry {
 public:
  SharedOdometry(const CameraFile& camera, const OdometryOptions& options, int threads)
      : odometry_(camera.Prior(options.calibration), options, threads) {}

  /// Returns what `work` returns for the odometry.
  template <typename Work>
  auto Run(Work&& work) {
    const nb::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    return work(odometry_);
  }

 private:
  std::mutex mutex_;
  Odometry odometry_;
};

ProcessedFrame Process(SharedOdometry& shared, nb::handle image, TimeNs timestamp_ns,
                       nb::handle mask) {
  const cv::Mat gray = ToGrayImage(image);
  const cv::Mat used = ToMask(mask);
  return shared.Run([&](Odometry& odometry) {
    FrameResult result = odometry.Process(gray, timestamp_ns, used);
    return WithTracks(std::move(result), odometry.last_frame());
  });
}

void BindProcessedFrame(nb::module_& module) {
  nb::class_<ProcessedFrame, FrameResult>(module, "ProcessedFrame",
                                          "The result of a frame with its tracks.")
      .def_prop_ro(
          "keypoints",
          [](const ProcessedFrame& frame) {
            return MoveToArray<Points2>(frame.pixels, {frame.landmarks.size(), 2});
          },
          nb::rv_policy::move,
          "float64 of shape (n, 2): the pixels (x, y) at which landmarks are observed.")
      .def_prop_ro(
          "landmarks",
          [](const ProcessedFrame& frame) {
            return MoveToArray<Ids>(frame.landmarks, {frame.landmarks.size()});
          },
          nb::rv_policy::move,
          "int64 of shape (n,): the id of the landmark that each keypoint observes.");
}

}  // namespace

void BindOdometry(nb::module_& module) {
  BindProcessedFrame(module);
  nb::class_<SharedOdometry>(module, "Odometry",
                             R"(Monocular visual odometry: images in, a pose for each.

It is deterministic: the same images, camera and options give the same results for any number of
threads. Threads may share an odometry: their calls wait for each other.

Args:
    camera: The camera of the images.
    options: The options; the defaults if left out.
    threads: Number of threads that share the work of a frame, 1 to 256. The map is adjusted on up
        to two more.

Raises:
    Error: An option or `threads` is out of range.)")
      .def(nb::init<const CameraFile&, const OdometryOptions&, int>(), nb::arg("camera"),
           nb::arg("options") = OdometryOptions(), nb::arg("threads") = 1)
      .def("process", &Process, nb::arg("image").none(), nb::arg("timestamp_ns"),
           nb::arg("mask") = nb::none(),
           nb::sig("def process(self, image: numpy.typing.NDArray[numpy.uint8], timestamp_ns: int, "
                   "mask: numpy.typing.NDArray[numpy.uint8] | None = None) -> ProcessedFrame"),
           R"(Processes one image.

Args:
    image: uint8 of the size of the camera: (height, width) for gray, (height, width, 3) for RGB,
        which is converted to 0.299 R + 0.587 G + 0.114 B. A gray image with contiguous rows is not
        copied.
    timestamp_ns: Time of the image, ns, later than that of the previous one.
    mask: uint8 of shape (height, width): features are detected only where it is not 0.

Raises:
    Error: An array has another dtype, shape or size, or the time is not later; the odometry is
        unchanged.)")
      .def(
          "finish",
          [](SharedOdometry& shared) {
            return shared.Run([](Odometry& odometry) { return odometry.Finish(); });
          },
          "Waits for the adjustments in progress and returns the final trajectory.")
      .def(
          "trajectory",
          [](SharedOdometry& shared) {
            return shared.Run([](Odometry& odometry) { return odometry.GetTrajectory(); });
          },
          "The trajectory as it is known now: later adjustments change earlier poses.");
}

}  // namespace corvo::python
