// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/dataset/image_reader.h"
#include "apps/output/calibration_report.h"
#include "vo/core/trajectory.h"
#include "vo/offline/calibration_check.h"
#include "vo/offline/match_residuals.h"
#include "vo/offline/parameter_check.h"

namespace corvo {

/// A range of frame indices, both included.
struct FrameRange {
  int first = 0;
  int last = 0;

  bool operator==(const FrameRange&) const = default;
};

/// Returns the ranges of frames whose scale is uncertain. Frames at most five apart are in one
/// range.
std::vector<FrameRange> UncertainScaleRanges(const Trajectory& trajectory);

/// Returns the ranges of the tenth of the posed frames whose position is the least certain, see
/// ExpectedDrift(). Frames at most five apart are in one range.
std::vector<FrameRange> LeastCertainRanges(const Trajectory& trajectory);

/// Returns ranges as text: "3-8, 20, 31-40", at most five of them.
std::string RangesText(const std::vector<FrameRange>& ranges);

/// Returns the number of frames that are blurred: their details are coarser than those of the
/// sharpest tenth of the frames by a factor of 1.7 or more.
int CountBlurredFrames(const Trajectory& trajectory);

// Each function returns a warning about a finished run, or an empty string.

/// Warns of images that are missing for one reason, and names the first.
std::string MissingImageWarning(Reason reason, const std::map<Reason, int>& counts,
                                const std::map<Reason, std::string>& first_errors);
/// Warns of frames of a video that cannot be decoded, or that its container promises in vain.
std::string VideoWarning(const std::optional<VideoFrames>& frames);
std::string ScaleWarning(const std::vector<FrameRange>& ranges);
/// Warns if more than a tenth of the frames are blurred.
std::string BlurWarning(int num_blurred, int num_frames);
std::string ResidualWarning(const std::optional<MatchResiduals>& residuals);
std::string FocalLengthWarning(const CalibrationCheck& check, double fx);
std::string DisagreementWarning(const CalibrationReport& report);
/// Names the parameters that were estimated because the images are evidence against their values.
std::string EvidenceWarning(const CalibrationReport& report);
std::string ContradictionWarning(const CalibrationReport& report);
std::string MisfitWarning(const std::vector<MisfittingParameter>& parameters);

}  // namespace corvo
