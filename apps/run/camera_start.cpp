// SPDX-License-Identifier: MIT
#include "apps/run/camera_start.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/run/progress_line.h"

namespace corvo {
namespace {

std::string StepText(const CalibrationStep& step, int num_sequences) {
  switch (step.stage) {
    case CalibrationStep::Stage::kFocalSearch:
      return "searching for the focal length";
    case CalibrationStep::Stage::kTracking:
      return fmt::format("calibrating: round {}, input {} of {}", step.round, step.sequence + 1,
                         num_sequences);
    case CalibrationStep::Stage::kAdjustment:
      return fmt::format("adjusting model {}", ToString(step.model));
  }
  return "";
}

}  // namespace

CalibrationProgress ShowCalibration(int num_sequences, const Interruption& interruption) {
  return [num_sequences, &interruption,
          line = std::make_shared<ProgressLine>()](const CalibrationStep& step) {
    line->Show(step.share, StepText(step, num_sequences));
    return !interruption.IsRequested();
  };
}

void ReportFocalSearch(const CameraStart& start) {
  const FocalSearchResult& search = start.search;
  if (search.is_determined) {
    spdlog::info("focal search: {:.1f} px from {} image pairs", search.camera.fx, search.num_pairs);
    return;
  }
  spdlog::warn(
      "the images do not determine the focal length ({} image pairs); it is initialized to "
      "{:.0f} px with a standard deviation of {:.0f}%. Record a scene that is not flat, and turn "
      "while moving instead of moving straight along the optical axis",
      search.num_pairs, search.camera.fx,
      100 * std::min(search.focal_sigma, SelfCalibrationOptions().max_focal_sigma));
}

CameraPrior FindSequenceCamera(const StreamOpener& sequence, const SelfCalibrationOptions& options,
                               const Interruption& interruption) {
  const std::optional<CameraStart> start =
      FindCamera(sequence, options, ShowCalibration(1, interruption));
  if (!start) throw Interrupted();
  ReportFocalSearch(*start);
  spdlog::info("first pass: {:.1f} px", start->prior.given.fx);
  return start->prior;
}

}  // namespace corvo
