// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "apps/output/evaluation_report.h"
#include "apps/output/final_map.h"
#include "apps/output/json_text.h"
#include "apps/run/evaluated_result.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/map_points.h"
#include "python/src/shared_odometry.h"
#include "vo/evaluation/evaluation.h"
#include "vo/offline/refiner.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

Refinement RefineSequence(SharedOdometry& shared) {
  return shared.Run([&](Odometry& odometry) {
    odometry.Finish();
    return Refine(odometry, shared.log());
  });
}

/// Evaluates as `corvo eval` does.
EvaluatedResult EvaluateFiles(const std::filesystem::path& estimate,
                              const std::filesystem::path& truth, const std::string& align,
                              std::optional<double> max_dt_s) {
  EvalArguments arguments;
  arguments.results = {estimate};
  arguments.truth = truth;
  arguments.alignment = align;
  arguments.max_dt_s = max_dt_s;
  return EvaluateResults(arguments).front();
}

/// Returns the measures of `corvo eval` as JSON.
std::string Measures(const EvaluatedResult& result) {
  return JsonText(ToJson(result.named.evaluation));
}

Ids ComparedTimes(const EvaluatedResult& result) {
  std::vector<std::int64_t> times;
  for (const PosePair& pair : result.named.evaluation.aligned_pairs) times.push_back(pair.time_ns);
  const std::size_t size = times.size();
  return MoveToArray<Ids>(std::move(times), {size});
}

Numbers ComparedErrors(const EvaluatedResult& result) {
  std::vector<double> errors = PositionErrors(result.named.evaluation.aligned_pairs);
  const std::size_t size = errors.size();
  return MoveToArray<Numbers>(std::move(errors), {size});
}

Ids TruthTimes(const EvaluatedResult& result) {
  std::vector<std::int64_t> times;
  for (const TimedPose& pose : result.inputs.truth) times.push_back(pose.time_ns);
  const std::size_t size = times.size();
  return MoveToArray<Ids>(std::move(times), {size});
}

Points3 TruthPositions(const EvaluatedResult& result) {
  std::vector<double> positions;
  for (const TimedPose& pose : result.inputs.truth) {
    const Eigen::Vector3d& position = pose.world_from_camera.translation();
    positions.insert(positions.end(), position.data(), position.data() + 3);
  }
  return MoveToArray<Points3>(std::move(positions), {result.inputs.truth.size(), 3});
}

void BindEvaluation(nb::module_& module) {
  nb::class_<EvaluatedResult>(module, "_Evaluation", "A trajectory beside the ground truth.")
      .def_prop_ro("measures", &Measures, "The measures of `corvo eval --json`, as JSON.")
      .def_prop_ro("timestamps_ns", &ComparedTimes, nb::rv_policy::automatic,
                   "int64 of shape (n,): the times of the compared poses.")
      .def_prop_ro("errors", &ComparedErrors, nb::rv_policy::automatic,
                   "float64 of shape (n,): their distances from the truth after the alignment, in "
                   "the unit of the truth.")
      .def_prop_ro("true_timestamps_ns", &TruthTimes, nb::rv_policy::automatic,
                   "int64 of shape (m,): the times of the whole truth.")
      .def_prop_ro("true_positions", &TruthPositions, nb::rv_policy::automatic,
                   "float64 of shape (m, 3): its positions.");
  module.def("_evaluate", &EvaluateFiles, nb::arg("estimate"), nb::arg("truth"), nb::arg("align"),
             nb::arg("max_dt_s").none(), nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace

void BindOffline(nb::module_& module) {
  nb::class_<Refinement>(module, "Refinement", "The result of adjusting a sequence as a whole.")
      .def_ro("trajectory", &Refinement::trajectory)
      .def_prop_ro(
          "landmarks",
          [](const Refinement& refinement) { return ToMapPoints(CollectPoints(refinement)); },
          "The landmarks that at least two adjusted frames observe.")
      .def_prop_ro(
          "is_usable",
          [](const Refinement& refinement) { return refinement.adjustment.is_usable(); },
          "Whether the adjustment succeeded; the trajectory is unchanged if not.")
      .def_ro("num_adjusted", &Refinement::num_adjusted,
              "Adjusted keyframes and frames between them.");
  module.def("refine", &RefineSequence, nb::arg("odometry"),
             R"(Finishes a sequence and adjusts its keyframes, landmarks and camera together.

Args:
    odometry: An odometry that was made with record=True. The folder of a result does not hold
        one, so that a finished run cannot be adjusted; run(..., refine=True) does it at its end.

Raises:
    Error: The odometry has no record.)");
  BindEvaluation(module);
}

}  // namespace corvo::python
