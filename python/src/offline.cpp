// SPDX-License-Identifier: MIT
#include <filesystem>
#include <optional>
#include <string>

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "apps/output/evaluation_report.h"
#include "apps/output/final_map.h"
#include "apps/output/json_text.h"
#include "apps/run/evaluated_result.h"
#include "python/src/bindings.h"
#include "python/src/map_points.h"
#include "python/src/shared_odometry.h"
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

/// Returns the measures of `corvo eval` as JSON.
std::string EvaluateFiles(const std::filesystem::path& estimate, const std::filesystem::path& truth,
                          const std::string& align, std::optional<double> max_dt_s) {
  EvalArguments arguments;
  arguments.results = {estimate};
  arguments.truth = truth;
  arguments.alignment = align;
  arguments.max_dt_s = max_dt_s;
  return JsonText(ToJson(EvaluateResults(arguments).front().named.evaluation));
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
  module.def("_evaluate", &EvaluateFiles, nb::arg("estimate"), nb::arg("truth"), nb::arg("align"),
             nb::arg("max_dt_s").none(), nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace corvo::python
