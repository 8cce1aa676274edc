// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/images.h"
#include "python/src/map_points.h"
#include "python/src/shared_odometry.h"
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

ProcessedFrame Process(SharedOdometry& shared, nb::handle image, TimeNs timestamp_ns,
                       nb::handle mask) {
  const cv::Mat gray = ToGrayImage(image);
  const cv::Mat used = ToMask(mask);
  return shared.Run([&](Odometry& odometry) {
    FrameResult result = odometry.Process(gray, timestamp_ns, used);
    return WithTracks(std::move(result), odometry.last_frame());
  });
}

ProcessedFrame ProcessMissing(SharedOdometry& shared, TimeNs timestamp_ns) {
  return shared.Run([&](Odometry& odometry) {
    return ProcessedFrame{odometry.ProcessMissing(timestamp_ns, Reason::kUnreadableImage), {}, {}};
  });
}

/// Returns the camera as it is estimated now, with its standard deviations.
CameraFile EstimatedCamera(SharedOdometry& shared) {
  return shared.Run([](Odometry& odometry) {
    const CameraEstimate& estimate = odometry.camera_estimate();
    return CameraFile{odometry.camera(), std::nullopt, "estimated by corvo",
                      Posterior(odometry.camera_prior().free, estimate.covariance)};
  });
}

MapPoints Landmarks(SharedOdometry& shared) {
  return ToMapPoints(shared.Run(
      [&](Odometry& odometry) { return CollectPoints(shared.marginalized(), odometry.map()); }));
}

/// Returns the landmarks whose ids are at least `first`.
MapPoints LandmarksFrom(SharedOdometry& shared, LandmarkId first) {
  return ToMapPoints(shared.Run([&](Odometry& odometry) {
    std::vector<MapPoint> points;
    for (LandmarkId id = std::max(first, 0); id < odometry.map().num_landmark_ids(); ++id) {
      const Landmark* const landmark = odometry.map().FindLandmark(id);
      if (landmark != nullptr) points.push_back({id, landmark->segment, landmark->in_world});
    }
    return points;
  }));
}

/// Returns the mask of the last image, or None.
nb::object UsedMask(SharedOdometry& shared) {
  return ToArray(shared.Run([](Odometry& odometry) { return odometry.last_mask().clone(); }));
}

void BindProcessedFrame(nb::module_& module) {
  nb::class_<ProcessedFrame, FrameResult>(module, "ProcessedFrame",
                                          "The result of a frame with its tracks.")
      .def_prop_ro(
          "keypoints",
          [](const ProcessedFrame& frame) {
            return MoveToArray<Points2>(frame.pixels, {frame.landmarks.size(), 2});
          },
          nb::rv_policy::automatic,
          "float64 of shape (n, 2): the pixels (x, y) at which landmarks are observed.")
      .def_prop_ro(
          "landmarks",
          [](const ProcessedFrame& frame) {
            return MoveToArray<Ids>(frame.landmarks, {frame.landmarks.size()});
          },
          nb::rv_policy::automatic,
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
    record: Whether all observations are kept, in a temporary file, for refine().

Raises:
    Error: An option or `threads` is out of range.)")
      .def(nb::init<const CameraFile&, const OdometryOptions&, int, bool>(), nb::arg("camera"),
           nb::arg("options") = OdometryOptions(), nb::arg("threads") = 1,
           nb::arg("record") = false)
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
          "The trajectory as it is known now: later adjustments change earlier poses.")
      .def("process_missing", &ProcessMissing, nb::arg("timestamp_ns"),
           R"(Adds a frame whose image could not be read: it gets no pose, and tracking goes on.

Raises:
    Error: The time is not later than that of the previous frame.)")
      .def(
          "pose_graph",
          [](SharedOdometry& shared) {
            return shared.Run([](Odometry& odometry) { return odometry.GetPoseGraph(); });
          },
          "The keyframes as they are known now, and how well their relative poses are known.")
      .def("landmarks", &Landmarks, "The sparse map as it is known now.")
      .def("landmarks_from", &LandmarksFrom, nb::arg("first"),
           "Those landmarks of active keyframes whose ids are `first` or larger: ids ascend in the "
           "order of creation.")
      .def_prop_ro("used_mask", &UsedMask,
                   nb::sig("def used_mask(self) -> numpy.typing.NDArray[numpy.uint8] | None"),
                   "uint8 of shape (height, width): the last image was searched for features where "
                   "it is not 0; None if everywhere. It is the given mask, less what moves with "
                   "the camera.")
      .def_prop_ro("camera", &EstimatedCamera,
                   "The camera as it is estimated now, with standard deviations.")
      .def(
          "reset",
          [](SharedOdometry& shared) { shared.Run([](Odometry& odometry) { odometry.Reset(); }); },
          "Returns to the state after construction.");
}

}  // namespace corvo::python
