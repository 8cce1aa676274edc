// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>
#include <CLI/App.hpp>

#include "apps/output/error_text.h"
#include "apps/run/result_images.h"
#include "apps/run/run_inputs.h"
#include "orb/error.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/images.h"
#include "python/src/shared_odometry.h"
#include "vo/io/trajectory_io.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

/// Parses the arguments of `corvo run` that say what is read, and with which options.
RunArguments Parse(std::vector<std::string> arguments) {
  CLI::App app("", "corvo view");
  RunArguments parsed;
  AddInputOptions(app, parsed);
  app.add_option("--gt", parsed.truth);
  app.add_option("--config", parsed.config);
  app.add_option("--threads", parsed.threads)->check(CLI::Range(1, 256));
  std::reverse(arguments.begin(), arguments.end());  // As CLI11 takes them.
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorText(error));
  }
  return parsed;
}

/// The images of a run and the odometry for them.
class Inputs {
 public:
  explicit Inputs(const std::vector<std::string>& arguments)
      : arguments_(Parse(arguments)), inputs_(Read(arguments_)) {}

  std::unique_ptr<SharedOdometry> MakeOdometry() const {
    return std::make_unique<SharedOdometry>(inputs_.camera, inputs_.options, arguments_.threads,
                                            false);
  }

  CameraFile camera() const { return {Camera(inputs_.camera.given), std::nullopt, "", {}}; }
  const RunTruth& truth() const { return inputs_.truth; }

  std::optional<TimedImage> Next() {
    const nb::gil_scoped_release release;
    return inputs_.source.Next();
  }

 private:
  static RunInputs Read(const RunArguments& arguments) {
    const nb::gil_scoped_release release;
    const Interruption interruption;
    try {
      return ReadInputs(arguments, interruption);
    } catch (const Interrupted&) {
      throw Error("interrupted during the calibration of the camera");
    }
  }

  RunArguments arguments_;
  RunInputs inputs_;
};

nb::tuple NextImage(Inputs& inputs) {
  const std::optional<TimedImage> next = inputs.Next();
  if (!next) throw nb::stop_iteration();
  return nb::make_tuple(next->time_ns, ToArray(next->image), ToArray(next->mask));
}

nb::tuple NextOfResult(ResultImages& images) {
  const std::optional<TimedImage> next = [&] {
    const nb::gil_scoped_release release;
    return images.Next();
  }();
  if (!next) throw nb::stop_iteration();
  return nb::make_tuple(images.NameOf(*next), ToArray(next->image), ToArray(next->mask));
}

Points3 TruePositions(const Inputs& inputs) {
  std::vector<double> positions;
  for (const TimedPose& pose : inputs.truth().poses) {
    const Eigen::Vector3d& position = pose.world_from_camera.translation();
    positions.insert(positions.end(), position.begin(), position.end());
  }
  const std::size_t count = positions.size() / 3;
  return MoveToArray<Points3>(std::move(positions), {count, 3});
}

void BindResultImages(nb::module_& module) {
  nb::class_<ResultImages>(module, "ResultImages", R"(The images of a finished run, as it used them.

They are read again from the input of the run. Iterating yields (name, image, mask): name is that in
frames.csv; image is uint8 of shape (height, width), or None if it cannot be read; mask is of the
same shape, or None.

Args:
    result: The folder of the result.

Raises:
    Error: The result or its input cannot be read, or the input was a live camera.)")
      .def(nb::init<const std::filesystem::path&>(), nb::arg("result"),
           nb::call_guard<nb::gil_scoped_release>())
      .def(
          "__iter__", [](nb::object self) { return self; },
          nb::sig("def __iter__(self) -> ResultImages"))
      .def("__next__", &NextOfResult,
           nb::sig("def __next__(self) -> tuple[str, numpy.typing.NDArray[numpy.uint8] | None, "
                   "numpy.typing.NDArray[numpy.uint8] | None]"));
}

}  // namespace

void BindInputs(nb::module_& module) {
  BindResultImages(module);
  nb::class_<Inputs>(module, "Inputs", R"(The images that `corvo run` reads, and its odometry.

Iterating yields (timestamp_ns, image, mask): image is uint8 of shape (height, width), or None if it
cannot be read; mask is of the same shape, or None.

Args:
    arguments: INPUT and the options of `corvo run` that say what is read and how.

Raises:
    Error: An argument or the input is invalid, with the message of the command.)")
      .def(nb::init<const std::vector<std::string>&>(), nb::arg("arguments"))
      .def("odometry", &Inputs::MakeOdometry, "Makes an odometry for the images.")
      .def_prop_ro("camera", &Inputs::camera, "The given camera of the images.")
      .def_prop_ro(
          "truth_file", [](const Inputs& inputs) { return inputs.truth().file.string(); },
          "The file of the ground truth, or an empty text.")
      .def(
          "write_truth",
          [](const Inputs& inputs, const std::filesystem::path& file) {
            WriteTum(file, inputs.truth().poses);
          },
          nb::arg("file"), "Writes the ground truth, as poses of the camera, in TUM's format.")
      .def_prop_ro("true_positions", &TruePositions, nb::rv_policy::automatic,
                   "float64 of shape (n, 3): the ground truth; n is 0 if there is none.")
      .def(
          "__iter__", [](nb::object self) { return self; }, nb::sig("def __iter__(self) -> Inputs"))
      .def("__next__", &NextImage,
           nb::sig("def __next__(self) -> tuple[int, numpy.typing.NDArray[numpy.uint8] | None, "
                   "numpy.typing.NDArray[numpy.uint8] | None]"));
}

}  // namespace corvo::python
