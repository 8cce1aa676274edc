// SPDX-License-Identifier: MIT
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "apps/dataset/named_camera.h"
#include "apps/dataset/shipped_cameras.h"
#include "orb/error.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/checked_arrays.h"
#include "python/src/config_text.h"
#include "vo/camera/camera.h"
#include "vo/io/config.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

/// Reads a camera as `corvo run --camera` does. The size is used if the file states none.
CameraFile LoadCamera(const std::filesystem::path& name, int width, int height) {
  const StatedCamera stated = ReadNamedCamera(name).camera;
  if (!stated.has_size() && (width == 0 || height == 0)) {
    throw Error(fmt::format("{}: states no image size; give width and height", name.string()));
  }
  return stated.ForImages(width, height);
}

std::map<std::string, double> ParametersOf(const CameraFile& file) {
  std::map<std::string, double> parameters;
  CameraParameters::Visit(file.camera.parameters(), [&](const char* name, double value, auto...) {
    parameters[name] = value;
  });
  return parameters;
}

std::optional<std::map<std::string, double>> SigmaOf(const CameraFile& file) {
  if (!file.sigma) return std::nullopt;
  std::map<std::string, double> sigma;
  for (const FreeParameter& parameter : *file.sigma) sigma[parameter.name] = parameter.sigma;
  return sigma;
}

/// Applies `map`, which returns an optional 2-vector, to each point. Points without a result get
/// NaN.
template <typename Point, typename Map>
Points2 MapPoints(const std::vector<Point>& points, Map&& map) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> results;
  results.reserve(2 * points.size());
  for (const Point& point : points) {
    const Eigen::Vector2d result = map(point).value_or(Eigen::Vector2d::Constant(kNone));
    results.insert(results.end(), {result.x(), result.y()});
  }
  return MoveToArray<Points2>(std::move(results), {points.size(), 2});
}

Points2 Project(const CameraFile& file, nb::handle points) {
  return MapPoints(ToPoints<3>(points, "points"),
                   [&](const Eigen::Vector3d& point) { return file.camera.Project(point); });
}

Points2 Undistort(const CameraFile& file, nb::handle pixels) {
  return MapPoints(ToPoints<2>(pixels, "pixels"),
                   [&](const Eigen::Vector2d& pixel) { return file.camera.Undistort(pixel); });
}

void BindParameters(nb::class_<CameraFile>& camera) {
  camera
      .def_prop_ro(
          "model",
          [](const CameraFile& file) {
            return std::string(ToString(file.camera.parameters().model));
          },
          "\"pinhole-radtan\", \"kb4\" or \"fov\".")
      .def_prop_ro(
          "width", [](const CameraFile& file) { return file.camera.width(); }, "Image width, px.")
      .def_prop_ro(
          "height", [](const CameraFile& file) { return file.camera.height(); },
          "Image height, px.")
      .def_prop_ro(
          "parameters", &ParametersOf,
          "The value of each parameter of the model by its name: width, height, fx, fy, cx, "
          "cy, px, and the distortion.")
      .def_prop_ro("sigma", &SigmaOf,
                   "The standard deviation of each parameter that is not exact, or None if none is "
                   "stated.")
      .def_ro("frame_rate_hz", &CameraFile::frame_rate_hz, "Images a second, or None.")
      .def_ro("source", &CameraFile::source, "The origin of the numbers.");
}

}  // namespace

void BindCamera(nb::module_& module) {
  nb::class_<CameraFile> camera(module, "Camera",
                                R"(A camera, with axes x right, y down, z forward.

Integer pixel coordinates are pixel centers. The keywords are the keys of a camera file: model,
width, height, fx, fy, cx, cy (px) and the model's distortion, 0 if left out: k1, k2, p1, p2, k3 of
"pinhole-radtan", k1 to k4 of "kb4", omega of "fov"; sigma, the standard deviations of parameters;
frame_rate_hz and source.

Raises:
    Error: A parameter is missing, unknown or out of range.)");
  camera.def(
      "__init__",
      [](CameraFile* self, const nb::kwargs& parameters) {
        const nb::dict values = nb::borrow<nb::dict>(parameters);
        new (self) CameraFile(ParseCameraFile(ConfigText(values), "camera"));
      },
      nb::sig("def __init__(self, *, model: str, width: int, height: int, fx: float, fy: float, "
              "cx: float, cy: float, k1: float = 0, k2: float = 0, p1: float = 0, p2: float = 0, "
              "k3: float = 0, k4: float = 0, omega: float = 0, sigma: dict[str, float] = {}, "
              "frame_rate_hz: float = 0, source: str = '') -> None"));
  camera.def_static("load", &LoadCamera, nb::arg("name"), nb::arg("width") = 0,
                    nb::arg("height") = 0, R"(Reads what `corvo run --camera` reads.

Args:
    name: A calibration file of corvo, OpenCV, ROS, Kalibr, COLMAP or another tool, "FILE:NAME" for
        one of several cameras in a file, or the name of a shipped camera, such as "tum_fr1".
    width, height: The size of the images, px, which is used if the file states none.

Raises:
    Error: There is no such file or camera, or it cannot be read.)");
  BindParameters(camera);
  camera
      .def("project", &Project, nb::arg("points").none(),
           nb::sig("def project(self, points: numpy.typing.NDArray[numpy.float64]) -> "
                   "numpy.typing.NDArray[numpy.float64]"),
           R"(Projects points in the frame of the camera, float64 of shape (n, 3).

Returns:
    Pixels, float64 of shape (n, 2); NaN for points that the camera cannot see.

Raises:
    Error: The array has another dtype or shape.)")
      .def("undistort", &Undistort, nb::arg("pixels").none(),
           nb::sig("def undistort(self, pixels: numpy.typing.NDArray[numpy.float64]) -> "
                   "numpy.typing.NDArray[numpy.float64]"),
           R"(Finds the rays (x/z, y/z) through pixels, float64 of shape (n, 2).

Returns:
    float64 of shape (n, 2); NaN for pixels outside the domain of the model.

Raises:
    Error: The array has another dtype or shape.)")
      .def("__str__", &WriteCameraFile, "The text of a camera file.")
      .def(
          "__eq__",
          [](const CameraFile& self, const CameraFile& other) {
            return WriteCameraFile(self) == WriteCameraFile(other);
          },
          nb::is_operator(), nb::sig("def __eq__(self, other: object, /) -> bool"));
  module.def("shipped_cameras", nb::overload_cast<>(&ShippedCameraNames),
             "The names of the cameras that are shipped with corvo.");
}

}  // namespace corvo::python
