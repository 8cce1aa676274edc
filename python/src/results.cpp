// SPDX-License-Identifier: MIT
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nanobind/eigen/dense.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <Eigen/Core>

#include "apps/output/frame_tables.h"
#include "apps/run/trajectory_file.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/map_points.h"
#include "vo/core/trajectory.h"
#include "vo/io/pose_graph_io.h"
#include "vo/io/trajectory_io.h"
#include "vo/map/pose_graph.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

std::optional<Eigen::Matrix4d> MatrixOf(const std::optional<SE3>& pose) {
  if (!pose) return std::nullopt;
  return pose->matrix();
}

std::optional<int> IdOf(int id) { return id == kNoId ? std::nullopt : std::optional(id); }

void BindRelativePose(nb::module_& module) {
  nb::class_<RelativePose>(module, "RelativePose",
                           "The pose of a frame relative to a keyframe of its segment.")
      .def_ro("reference", &RelativePose::reference, "Index of the keyframe's frame.")
      .def_prop_ro(
          "reference_from_camera",
          [](const RelativePose& pose) { return pose.reference_from_camera.matrix(); },
          "float64 of shape (4, 4): x_in_reference = reference_from_camera @ x_in_camera.")
      .def_ro("covariance", &RelativePose::covariance,
              "float64 of shape (6, 6): covariance of the error [u w] of reference_from_camera "
              "Exp([u w]), translation (unit of the segment) before rotation (rad).");
}

void BindFrameResult(nb::module_& module) {
  nb::class_<FrameResult>(module, "FrameResult", "The outcome and pose of one input frame.")
      .def_ro("index", &FrameResult::index, "Index of the input frame, from 0.")
      .def_ro("timestamp_ns", &FrameResult::time_ns, "Time of the image, ns.")
      .def_prop_ro(
          "state", [](const FrameResult& frame) { return std::string(ToString(frame.state)); },
          "\"initializing\", \"tracking\", \"rotation_only\" or \"lost\".")
      .def_prop_ro(
          "reason", [](const FrameResult& frame) { return std::string(ToString(frame.reason)); },
          "Why the frame has no pose or a doubtful one, or \"none\".")
      .def_prop_ro(
          "world_from_camera",
          [](const FrameResult& frame) { return MatrixOf(frame.world_from_camera); },
          "float64 of shape (4, 4), or None without a pose: x_in_world = world_from_camera @ "
          "x_in_camera. Only poses of one segment are comparable.")
      .def_prop_ro(
          "rotation",
          [](const FrameResult& frame) -> std::optional<Eigen::Matrix3d> {
            if (!frame.world_from_camera_rotation) return std::nullopt;
            return frame.world_from_camera_rotation->matrix();
          },
          "float64 of shape (3, 3), or None: the rotation of a frame that is posed or in the state "
          "\"rotation_only\".")
      .def_ro("relative_pose", &FrameResult::relative_pose,
              "The pose relative to a keyframe with its covariance, or None.")
      .def_ro("is_keyframe", &FrameResult::is_keyframe)
      .def_prop_ro(
          "segment", [](const FrameResult& frame) { return IdOf(frame.segment); },
          "Index of the segment, or None before the first.")
      .def_prop_ro(
          "repeats", [](const FrameResult& frame) { return IdOf(frame.repeats); },
          "Index of the frame whose image this one repeats, or None.")
      .def_ro("num_features", &FrameResult::num_features)
      .def_ro("num_matches", &FrameResult::num_matches,
              "Matches with the reference frame or, with a map, with landmarks.")
      .def_ro("num_inliers", &FrameResult::num_inliers,
              "Matches that are consistent with the motion or pose.")
      .def_ro("parallax_deg", &FrameResult::parallax_deg,
              "Median over the matches, rotation removed; while initializing.")
      .def_ro("masked_share", &FrameResult::masked_share,
              "Share of the image that moves with the camera, 0 to 1.")
      .def("__repr__", [](const FrameResult& frame) {
        return "<FrameResult " + std::to_string(frame.index) + " " +
               std::string(ToString(frame.state)) + ", " + std::string(ToString(frame.reason)) +
               ">";
      });
}

Ids TimesOf(const PoseSequence& poses) {
  std::vector<std::int64_t> times;
  for (const TimedPose& pose : poses) times.push_back(pose.time_ns);
  return MoveToArray<Ids>(std::move(times), {poses.size()});
}

Poses MatricesOf(const PoseSequence& poses) {
  std::vector<double> matrices;
  for (const TimedPose& pose : poses) AppendMatrix(pose.world_from_camera, matrices);
  return MoveToArray<Poses>(std::move(matrices), {poses.size(), 4, 4});
}

void BindTrajectory(nb::module_& module) {
  nb::class_<Trajectory>(module, "Trajectory", "The results of all input frames, in input order.")
      .def_ro("frames", &Trajectory::frames, "The FrameResult of every input frame.")
      .def_prop_ro(
          "timestamps_ns",
          [](const Trajectory& trajectory) { return TimesOf(trajectory.PosedFrames()); },
          nb::rv_policy::automatic, "int64 of shape (n,): times of the posed frames.")
      .def_prop_ro(
          "world_from_camera",
          [](const Trajectory& trajectory) { return MatricesOf(trajectory.PosedFrames()); },
          nb::rv_policy::automatic, "float64 of shape (n, 4, 4): poses of the posed frames.")
      .def_prop_ro("posed_share", &Trajectory::PosedShare, "Share of frames with a pose, 0 to 1.")
      .def("__len__", [](const Trajectory& trajectory) { return trajectory.frames.size(); })
      .def(
          "to_frame",
          [](const Trajectory& trajectory) {
            return nb::module_::import_("corvo.frames").attr("to_frame")(FrameTable(trajectory));
          },
          nb::sig("def to_frame(self) -> pandas.DataFrame"),
          "The frames.csv of the command as a pandas.DataFrame. Raises Error without pandas.")
      .def(
          "to_csv", [](const Trajectory& trajectory) { return FrameTable(trajectory); },
          "The text of the frames.csv of the command: a row for each frame.")
      .def(
          "write_tum",
          [](const Trajectory& trajectory, const std::filesystem::path& file) {
            WriteTrajectory(file, trajectory);
          },
          nb::arg("file"), nb::call_guard<nb::gil_scoped_release>(),
          R"(Writes the posed frames as the trajectory.tum of the command.

Raises:
    Error: The file cannot be written.)");
}

void BindMapPoints(nb::module_& module) {
  nb::class_<MapPoints>(module, "MapPoints", "The landmarks of a map, with equal indices.")
      .def_prop_ro(
          "ids",
          [](const MapPoints& points) { return MoveToArray<Ids>(points.ids, {points.ids.size()}); },
          nb::rv_policy::automatic, "int64 of shape (n,).")
      .def_prop_ro(
          "segments",
          [](const MapPoints& points) {
            return MoveToArray<Ids>(points.segments, {points.ids.size()});
          },
          nb::rv_policy::automatic, "int64 of shape (n,): the segment of each.")
      .def_prop_ro(
          "positions",
          [](const MapPoints& points) {
            return MoveToArray<Points3>(points.positions, {points.ids.size(), 3});
          },
          nb::rv_policy::automatic, "float64 of shape (n, 3), in the world of the segment.")
      .def("__len__", [](const MapPoints& points) { return points.ids.size(); });
}

void BindPoseGraph(nb::module_& module) {
  nb::class_<PoseGraphVertex>(module, "PoseGraphVertex", "A keyframe of a pose graph.")
      .def_ro("keyframe", &PoseGraphVertex::keyframe, "Id of the keyframe.")
      .def_ro("frame", &PoseGraphVertex::frame, "Index of its input frame.")
      .def_ro("segment", &PoseGraphVertex::segment, "Index of its segment.")
      .def_prop_ro(
          "world_from_camera",
          [](const PoseGraphVertex& vertex) { return vertex.world_from_camera.matrix(); },
          "float64 of shape (4, 4).");
  nb::class_<PoseGraphEdge>(module, "PoseGraphEdge",
                            "The pose of a keyframe relative to an earlier one of its segment.")
      .def_ro("first", &PoseGraphEdge::first, "Id of the earlier keyframe.")
      .def_ro("second", &PoseGraphEdge::second, "Id of the later keyframe.")
      .def_prop_ro(
          "first_from_second",
          [](const PoseGraphEdge& edge) { return edge.first_from_second.matrix(); },
          "float64 of shape (4, 4).")
      .def_ro(
          "covariance", &PoseGraphEdge::covariance,
          "float64 of shape (7, 7): covariance of [u w l], where l is the logarithm of the unit "
          "of length at the second keyframe in that at the first.");
  nb::class_<PoseGraph>(module, "PoseGraph",
                        "The keyframes of a sequence and how well their relative poses are known.")
      .def_ro("vertices", &PoseGraph::vertices, "In ascending order of keyframes.")
      .def_ro("edges", &PoseGraph::edges, "In ascending order of `second`, then `first`.")
      .def(
          "to_g2o",
          [](const PoseGraph& graph, bool with_scale) {
            return ToG2o(graph, with_scale ? G2oForm::kSim3 : G2oForm::kSe3);
          },
          nb::arg("with_scale") = false,
          "The text of a g2o file: the pose_graph.g2o, or pose_graph_sim3.g2o, of the command.");
}

/// Reads a file in TUM's format as timestamps and poses.
std::pair<Ids, Poses> ReadTrajectory(const std::filesystem::path& file) {
  const PoseSequence poses = ReadTum(file);
  return {TimesOf(poses), MatricesOf(poses)};
}

}  // namespace

void BindResults(nb::module_& module) {
  BindRelativePose(module);
  BindFrameResult(module);
  BindTrajectory(module);
  BindMapPoints(module);
  BindPoseGraph(module);
  module.def("read_tum", &ReadTrajectory, nb::arg("file"),
             R"(Reads a trajectory in TUM's format.

Returns:
    The timestamps, int64 of shape (n,), ns, and the poses, float64 of shape (n, 4, 4).

Raises:
    Error: The file cannot be read, or a line is not a pose; the message names it.)");
}

}  // namespace corvo::python
