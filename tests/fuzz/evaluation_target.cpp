// SPDX-License-Identifier: MIT
#include "tests/fuzz/targets.h"
#include "vo/evaluation/evaluation.h"

namespace corvo::fuzz {
namespace {

Eigen::Vector3d TakePosition(int kind, int index, Input& input) {
  switch (kind) {
    case 0:
      return input.Vector(10);
    case 1:
      return {1.0 * index, 0, 0};
    case 2:
      return {1, 2, 3};
    case 3:
      return {input.Real(-1, 1), 0, 0};
    default:
      break;
  }
  const double x = input.Number(1e12), y = input.Number(1e12), z = input.Number(1e12);
  return {x, y, z};
}

PoseSequence TakePoses(Input& input) {
  PoseSequence poses;
  const int count = input.Int(0, 40), kind = input.Int(0, 4);
  TimeNs time_ns = input.Bool() ? input.Raw<TimeNs>() : 0;
  for (int i = 0; i < count; ++i) {
    const SO3 rotation = SO3::Exp(input.Vector(4));
    poses.push_back({time_ns, SE3(rotation, TakePosition(kind, i, input))});
    const TimeNs step = 1 + TimeNs{input.Raw<std::uint16_t>()} * (input.Bool() ? 1000 : 1LL << 46);
    if (__builtin_add_overflow(time_ns, step, &time_ns)) break;
  }
  return poses;
}

void RequireFinite(const ErrorStatistics& errors) {
  if (errors.count == 0) return;
  Require(std::isfinite(errors.rmse) && std::isfinite(errors.mean) &&
              std::isfinite(errors.median) && std::isfinite(errors.max),
          "statistics of errors are finite");
}

}  // namespace

void FuzzEvaluation(Bytes bytes) {
  Input input(bytes);
  EvaluationOptions options;
  options.alignment = static_cast<Alignment>(input.Int(0, 3));
  if (input.Bool()) options.max_dt_ns = input.Raw<std::uint32_t>();
  options.relative_delta_frames = input.Int(1, 50);
  if (input.Bool()) options.relative_delta_path = input.Real(1e-6, 10);
  const PoseSequence estimate = TakePoses(input);
  const PoseSequence truth = input.Bool() ? estimate : TakePoses(input);
  AllowError([&] {
    const Evaluation evaluation = Evaluate(estimate, truth, options);
    Require(evaluation.coverage >= 0 && evaluation.coverage <= 1, "coverage is a share");
    Require(evaluation.truth_from_estimate.translation().allFinite(), "the alignment is finite");
    RequireFinite(evaluation.absolute);
    RequireFinite(evaluation.relative_frames.translation);
    RequireFinite(evaluation.relative_frames.rotation_deg);
    RequireFinite(evaluation.relative_time.translation);
    if (evaluation.relative_path) RequireFinite(evaluation.relative_path->translation);
    if (evaluation.kitti) {
      Require(std::isfinite(evaluation.kitti->t_rel_percent), "the drift is finite");
    }
    if (evaluation.scale_drift) {
      Require(std::isfinite(evaluation.scale_drift->percent_per_km), "scale drift is finite");
    }
  });
}

}  // namespace corvo::fuzz
