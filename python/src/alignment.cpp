// SPDX-License-Identifier: MIT
#include <filesystem>
#include <utility>
#include <vector>

#include <nanobind/eigen/dense.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>

#include "orb/error.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "vo/core/trajectory.h"
#include "vo/evaluation/evaluation.h"
#include "vo/io/trajectory_io.h"
#include "vo/lie/sim3.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

using TimesIn = nb::ndarray<const std::int64_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using PositionsIn = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

std::pair<Ids, Poses> ReadTimesAndPoses(const std::filesystem::path& file) {
  const PoseSequence sequence = ReadTum(file);
  std::vector<std::int64_t> times;
  std::vector<double> matrices;
  for (const TimedPose& pose : sequence) {
    times.push_back(pose.time_ns);
    AppendMatrix(pose.world_from_camera, matrices);
  }
  return {MoveToArray<Ids>(std::move(times), {sequence.size()}),
          MoveToArray<Poses>(std::move(matrices), {sequence.size(), 4, 4})};
}

/// Returns poses without a rotation.
PoseSequence ToSequence(const TimesIn& times, const PositionsIn& positions, const char* name) {
  if (times.shape(0) != positions.shape(0)) {
    throw Error(std::string(name) + ": there must be as many times as positions");
  }
  PoseSequence sequence(times.shape(0));
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> position(positions.data() + 3 * i);
    sequence[i] = {times.data()[i], SE3(SO3(), position)};
  }
  return sequence;
}

/// Returns [sR t; 0 1] of the similarity from the world of the ground truth to the estimate's.
Eigen::Matrix4d AlignTruth(const TimesIn& times, const PositionsIn& positions,
                           const TimesIn& truth_times, const PositionsIn& truth_positions) {
  const PoseSequence estimate = ToSequence(times, positions, "estimate");
  const PoseSequence truth = ToSequence(truth_times, truth_positions, "truth");
  const std::vector<PosePair> pairs = Associate(estimate, truth, HalfFrame(estimate));
  const Sim3 estimate_from_truth = Align(pairs, Alignment::kSim3).Inverse();
  return estimate_from_truth.matrix();
}

}  // namespace

void BindAlignment(nb::module_& module) {
  module.def("read_trajectory", &ReadTimesAndPoses, nb::arg("file"),
             R"(Reads a trajectory in TUM's format, such as trajectory.tum.

Returns:
    The timestamps, ns, int64 of shape (n,), and world_from_camera, float64 of shape (n, 4, 4).

Raises:
    Error: The file cannot be read; the message names file and line.)");
  module.def("align_truth", &AlignTruth, nb::arg("timestamps_ns"), nb::arg("positions"),
             nb::arg("truth_timestamps_ns"), nb::arg("truth_positions"),
             R"(Aligns ground truth with an estimate, as `corvo eval` does the inverse.

Args:
    timestamps_ns, truth_timestamps_ns: Ascending, ns, int64 of shape (n,) and (m,). Those at most
        half a frame apart belong together.
    positions, truth_positions: float64 of shape (n, 3) and (m, 3).

Returns:
    float64 of shape (4, 4), the similarity [sR t; 0 1] with the least squared distances:
    x_in_estimate = estimate_from_truth @ x_in_truth.

Raises:
    Error: There are fewer than 3 pairs, or all positions are equal.)");
}

}  // namespace corvo::python
