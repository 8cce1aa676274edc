// SPDX-License-Identifier: MIT
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nanobind/eigen/dense.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <Eigen/Core>

#include "orb/error.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/checked_arrays.h"
#include "vo/core/options.h"
#include "vo/geometry/two_view.h"
#include "vo/io/config.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

/// The motion between two views, with the matches that it was found from.
struct TwoViewMotion {
  TwoViewResult result;
  std::vector<int> matches;  ///< Index of the given match of each match with rays.
};

/// The matches whose pixels have rays.
struct RayMatches {
  std::vector<RayMatch> rays;
  std::vector<int> matches;
};

RayMatches ToRays(const std::vector<Eigen::Vector2d>& first,
                  const std::vector<Eigen::Vector2d>& second, const Camera& camera,
                  double sigma_px) {
  RayMatches found;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto a = camera.Undistort(first[i]);
    const auto b = camera.Undistort(second[i]);
    if (!a || !b) continue;
    found.rays.push_back({*a, *b, sigma_px / camera.focal()});
    found.matches.push_back(static_cast<int>(i));
  }
  return found;
}

TwoViewMotion EstimateTwoView(nb::handle first, nb::handle second, const CameraFile& file,
                              double sigma_px, const OdometryOptions& options) {
  const std::vector<Eigen::Vector2d> a = ToPoints<2>(first, "first");
  const std::vector<Eigen::Vector2d> b = ToPoints<2>(second, "second");
  if (a.size() != b.size()) {
    throw Error(
        fmt::format("second has {} pixels; allowed is {}, as first has", b.size(), a.size()));
  }
  CheckRange("sigma_px", sigma_px, 1e-3, 1e3);
  const nb::gil_scoped_release release;
  RayMatches found = ToRays(a, b, file.camera, sigma_px);
  return {EstimateTwoViewMotion(found.rays, options.initializer), std::move(found.matches)};
}

Points3 PointsOf(const TwoViewMotion& motion) {
  std::vector<double> points;
  for (const TwoViewPoint& point : motion.result.points) {
    points.insert(points.end(), point.in_first.begin(), point.in_first.end());
  }
  const std::size_t count = points.size() / 3;
  return MoveToArray<Points3>(std::move(points), {count, 3});
}

Ids MatchesOf(const TwoViewMotion& motion) {
  std::vector<std::int64_t> matches;
  for (const TwoViewPoint& point : motion.result.points) {
    matches.push_back(motion.matches[point.match]);
  }
  const std::size_t count = matches.size();
  return MoveToArray<Ids>(std::move(matches), {count});
}

std::optional<Eigen::Matrix4d> MotionOf(const TwoViewMotion& motion) {
  if (motion.result.reason != Reason::kNone) return std::nullopt;
  return motion.result.first_from_second.matrix();
}

std::optional<Eigen::Matrix3d> RotationOf(const TwoViewMotion& motion) {
  if (!motion.result.first_from_second_rotation) return std::nullopt;
  return motion.result.first_from_second_rotation->matrix();
}

}  // namespace

void BindGeometry(nb::module_& module) {
  nb::class_<TwoViewMotion>(module, "TwoViewMotion",
                            "The motion between two views, or the reason why there is none.")
      .def_prop_ro(
          "reason",
          [](const TwoViewMotion& motion) { return std::string(ToString(motion.result.reason)); },
          "\"none\" if the motion is accepted, or why not, in the words of FrameResult.reason.")
      .def_prop_ro("first_from_second", &MotionOf,
                   "float64 of shape (4, 4), with a baseline of length 1, or None.")
      .def_prop_ro("rotation", &RotationOf,
                   "float64 of shape (3, 3), first from second, or None: set if the camera only "
                   "turned or stood still.")
      .def_prop_ro("points", &PointsOf, nb::rv_policy::automatic,
                   "float64 of shape (m, 3): the points in the frame of the first camera.")
      .def_prop_ro("matches", &MatchesOf, nb::rv_policy::automatic,
                   "int64 of shape (m,): the index of the match of each point.")
      .def_prop_ro("num_inliers",
                   [](const TwoViewMotion& motion) { return motion.result.num_inliers; })
      .def_prop_ro(
          "parallax_deg", [](const TwoViewMotion& motion) { return motion.result.parallax_deg; },
          "Median over the matches, rotation removed.");
  module.def("two_view", &EstimateTwoView, nb::arg("first").none(), nb::arg("second").none(),
             nb::arg("camera"), nb::arg("sigma_px") = 1.0, nb::arg("options") = OdometryOptions(),
             nb::sig("def two_view(first: numpy.typing.NDArray[numpy.float64], "
                     "second: numpy.typing.NDArray[numpy.float64], camera: Camera, "
                     "sigma_px: float = 1.0, options: Options = ...) -> TwoViewMotion"),
             R"(Estimates the motion between two views of one camera from matches.

The motion is accepted only if there are enough matches with parallax, if neither a pure rotation
nor a plane explains them, and if the points lie clearly in front of both views.

Args:
    first, second: Corresponding pixels, float64 of shape (n, 2).
    camera: The camera of both.
    sigma_px: Standard deviation of a pixel along each axis.
    options: The options, of which the section `initializer` is used.

Raises:
    Error: An array has another dtype or shape, the numbers of pixels differ, or `sigma_px` is out
        of range.)");
}

}  // namespace corvo::python
