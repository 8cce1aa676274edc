// SPDX-License-Identifier: MIT
#include "apps/output/refinement_report.h"

#include <fmt/format.h>

namespace corvo {
namespace {

std::string WhyNotRefined(AdjustmentStatus status) {
  switch (status) {
    case AdjustmentStatus::kConverged:
    case AdjustmentStatus::kIterationLimit:
      return "";
    case AdjustmentStatus::kNone:
    case AdjustmentStatus::kNoObservations:
      return "there is nothing to adjust";
    case AdjustmentStatus::kSolverFailed:
      return "the solver failed";
    case AdjustmentStatus::kInvalidCamera:
      return "the solution is not a camera";
    case AdjustmentStatus::kNotImproved:
      return "the robust cost would be higher";
    case AdjustmentStatus::kCanceled:
      return "it was interrupted";
  }
  return "";
}

}  // namespace

RefinementReport ReportRefinement(const Refinement& refinement) {
  const AdjustmentSummary& adjustment = refinement.adjustment;
  RefinementReport report;
  report.why_not = WhyNotRefined(adjustment.status);
  report.cost_before = adjustment.initial_cost;
  report.cost_after = adjustment.final_cost;
  report.num_observations = adjustment.num_observations;
  report.num_inliers = adjustment.num_inliers;
  report.num_adjusted = refinement.num_adjusted;
  report.num_placed = refinement.num_placed;
  report.num_moved = refinement.num_moved;
  return report;
}

nlohmann::ordered_json ToJson(const RefinementReport& report) {
  const bool is_refined = report.why_not.empty();
  nlohmann::ordered_json json = {{"refined", is_refined}, {"cost_before", report.cost_before}};
  if (!is_refined) {
    json["why_not"] = report.why_not;
    return json;
  }
  json["cost_after"] = report.cost_after;
  json["observations"] = report.num_observations;
  json["inliers"] = report.num_inliers;
  json["frames_adjusted"] = report.num_adjusted;
  json["frames_placed"] = report.num_placed;
  json["frames_moved"] = report.num_moved;
  return json;
}

std::string ToText(const RefinementReport& report) {
  if (!report.why_not.empty()) return fmt::format("not refined: {}\n", report.why_not);
  return fmt::format(
      "refined: robust cost {:.1f} -> {:.1f} over {} observations; {} frames adjusted, {} located "
      "again, {} moved along\n",
      report.cost_before, report.cost_after, report.num_observations, report.num_adjusted,
      report.num_placed, report.num_moved);
}

}  // namespace corvo
