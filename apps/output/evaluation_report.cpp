// SPDX-License-Identifier: MIT
#include "apps/output/evaluation_report.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace corvo {
namespace {

using Json = nlohmann::ordered_json;

Json RelativeJson(const RelativeError& error) {
  return {{"translation", ToJson(error.translation)}, {"rotation_deg", ToJson(error.rotation_deg)}};
}

/// Returns the errors and, under the name `key`, the interval of the relative motions.
template <typename Span>
Json RelativeJson(const char* key, Span span, const RelativeError& error) {
  Json json = {{key, span}};
  json.update(RelativeJson(error));
  return json;
}

Json KittiJson(const KittiDrift& drift) {
  Json json = {{"t_rel_percent", drift.t_rel_percent},
               {"r_rel_deg_per_100m", drift.r_rel_deg_per_100m},
               {"lengths", Json::array()}};
  for (const StretchDrift& stretch : drift.lengths) {
    json["lengths"].push_back({{"length_m", stretch.length_m},
                               {"count", stretch.count},
                               {"t_rel_percent", stretch.t_rel_percent},
                               {"r_rel_deg_per_100m", stretch.r_rel_deg_per_100m}});
  }
  return json;
}

Json AlignmentJson(const Sim3& transform) {
  const SE3::Data data = SE3(transform.rotation(), transform.translation()).data();
  return {{"scale", transform.scale()},
          {"quaternion_xyzw", {data[0], data[1], data[2], data[3]}},
          {"translation", {data[4], data[5], data[6]}}};
}

/// Returns std::nullopt if the ground truth stands still.
std::optional<double> PercentOfPath(const Evaluation& evaluation) {
  const double percent = 100 * evaluation.absolute.rmse / evaluation.truth_path_length;
  return std::isfinite(percent) ? std::optional(percent) : std::nullopt;
}

std::string RelativeText(const std::string& name, const RelativeError& error) {
  return ToText(name, error.translation, "") + ToText("", error.rotation_deg, " deg");
}

std::string DriftText(const Evaluation& evaluation) {
  std::string text;
  if (evaluation.kitti) {
    text += fmt::format("{:<22} {:.3f}%, {:.3f} deg/100 m\n", "KITTI t_rel, r_rel",
                        evaluation.kitti->t_rel_percent, evaluation.kitti->r_rel_deg_per_100m);
  }
  if (evaluation.scale_drift) {
    text += fmt::format("{:<22} {:.4g}\n", "scale, last/first 1/3",
                        evaluation.scale_drift->last_over_first);
  }
  return text;
}

}  // namespace

Json ToJson(const ErrorStatistics& errors) {
  if (errors.count == 0) return {{"count", 0}};
  return {{"count", errors.count},
          {"rmse", errors.rmse},
          {"mean", errors.mean},
          {"median", errors.median},
          {"max", errors.max}};
}

Json ToJson(const Evaluation& evaluation) {
  const EvaluationOptions& options = evaluation.options;
  Json json;
  json["pairs"] = evaluation.num_pairs;
  json["coverage"] = evaluation.coverage;
  json["max_dt_s"] = ToSeconds(*options.max_dt_ns);
  json["truth_path_length"] = evaluation.truth_path_length;
  json["ate"] = ToJson(evaluation.absolute);
  if (const auto percent = PercentOfPath(evaluation)) json["ate"]["percent_of_path"] = *percent;
  json["rpe_frames"] =
      RelativeJson("frames", options.relative_delta_frames, evaluation.relative_frames);
  json["rpe_time"] =
      RelativeJson("seconds", ToSeconds(options.relative_delta_ns), evaluation.relative_time);
  if (evaluation.relative_path) {
    json["rpe_path"] =
        RelativeJson("length", *options.relative_delta_path, *evaluation.relative_path);
  }
  if (evaluation.kitti) json["kitti"] = KittiJson(*evaluation.kitti);
  if (evaluation.scale_drift) {
    json["scale_drift"] = {{"last_over_first", evaluation.scale_drift->last_over_first},
                           {"percent_per_km", evaluation.scale_drift->percent_per_km}};
  }
  json["truth_from_estimate"] = AlignmentJson(evaluation.truth_from_estimate);
  return json;
}

std::string AteText(const Evaluation& evaluation) {
  const double rmse = evaluation.absolute.rmse;
  return rmse < 1000 ? fmt::format("ATE rmse {:.3g} m", rmse)
                     : fmt::format("ATE rmse {:.0f} m", rmse);
}

std::string ToText(const std::string& name, const ErrorStatistics& errors,
                   const std::string& unit) {
  if (errors.count == 0) return fmt::format("{:<22} none\n", name);
  return fmt::format("{:<22} rmse {:.6g}, mean {:.6g}, median {:.6g}, max {:.6g}{}\n", name,
                     errors.rmse, errors.mean, errors.median, errors.max, unit);
}

std::string ToText(const Evaluation& evaluation) {
  const EvaluationOptions& options = evaluation.options;
  std::string text =
      fmt::format("{:<22} {} pairs, {:.1f}% of the ground truth, path {:.6g}\n", "compared",
                  evaluation.num_pairs, 100 * evaluation.coverage, evaluation.truth_path_length);
  const std::optional<double> percent = PercentOfPath(evaluation);
  text += ToText("ATE", evaluation.absolute,
                 percent ? fmt::format(" ({:.3f}% of the path)", *percent) : "");
  text += RelativeText(fmt::format("RPE over {} frame{}", options.relative_delta_frames,
                                   options.relative_delta_frames == 1 ? "" : "s"),
                       evaluation.relative_frames);
  text += RelativeText(fmt::format("RPE over {:.6g} s", ToSeconds(options.relative_delta_ns)),
                       evaluation.relative_time);
  if (evaluation.relative_path) {
    text += RelativeText(fmt::format("RPE over {:.6g} of path", *options.relative_delta_path),
                         *evaluation.relative_path);
  }
  return text + DriftText(evaluation);
}

}  // namespace corvo
