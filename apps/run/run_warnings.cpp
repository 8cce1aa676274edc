// SPDX-License-Identifier: MIT
#include "apps/run/run_warnings.h"

#include <algorithm>
#include <functional>
#include <vector>

#include <fmt/format.h>

namespace corvo {
namespace {

/// Returns the ranges of the frames that are selected by their index.
std::vector<FrameRange> RangesOf(const std::vector<char>& is_selected) {
  constexpr int kMaxGap = 5;
  std::vector<FrameRange> ranges;
  for (int i = 0; i < static_cast<int>(is_selected.size()); ++i) {
    if (!is_selected[i]) continue;
    if (ranges.empty() || i > ranges.back().last + kMaxGap) ranges.push_back({i, i});
    ranges.back().last = i;
  }
  return ranges;
}

/// Returns an estimate of a parameter beside its other value, which `other_is` names.
std::string DifferenceText(const std::string& name, double value, double sigma,
                           const char* other_is, double other) {
  return fmt::format("{} {:.4g} ± {:.2g} ({}: {:.4g})", name, value, sigma, other_is, other);
}

}  // namespace

std::vector<FrameRange> UncertainScaleRanges(const Trajectory& trajectory) {
  std::vector<char> is_uncertain;
  for (const FrameResult& frame : trajectory.frames) {
    is_uncertain.push_back(frame.reason == Reason::kScaleUncertain);
  }
  return RangesOf(is_uncertain);
}

std::vector<FrameRange> LeastCertainRanges(const Trajectory& trajectory) {
  std::vector<double> sigmas;
  for (const FrameResult& frame : trajectory.frames) {
    if (frame.world_from_camera) sigmas.push_back(frame.health.drift_sigma);
  }
  if (sigmas.size() < 10) return {};
  const auto limit = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 10);
  std::nth_element(sigmas.begin(), limit, sigmas.end(), std::greater<>());
  std::vector<char> is_uncertain;
  for (const FrameResult& frame : trajectory.frames) {
    is_uncertain.push_back(frame.world_from_camera && frame.health.drift_sigma > *limit);
  }
  return RangesOf(is_uncertain);
}

std::string RangesText(const std::vector<FrameRange>& ranges) {
  constexpr std::size_t kMaxRanges = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(ranges.size(), kMaxRanges); ++i) {
    const auto [first, last] = ranges[i];
    text += i == 0 ? "" : ", ";
    text += first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
  }
  if (ranges.size() <= kMaxRanges) return text;
  return text + fmt::format(" and {} other ranges", ranges.size() - kMaxRanges);
}

std::string MissingImageWarning(Reason reason, const std::map<Reason, int>& counts,
                                const std::map<Reason, std::string>& first_errors) {
  const auto count = counts.find(reason);
  const auto error = first_errors.find(reason);
  if (count == counts.end() || error == first_errors.end()) return "";
  return fmt::format("{} image{} not used ({}), the first: {}", count->second,
                     count->second == 1 ? " was" : "s were", ToString(reason), error->second);
}

std::string VideoWarning(const std::optional<VideoFrames>& frames) {
  if (!frames) return "";
  if (frames->num_damaged == 0 && !frames->is_cut_off) return "";
  return fmt::format(
      "the video is {}: it promises {} frames, {} were read{}",
      frames->is_cut_off ? "cut off or damaged" : "damaged", frames->num_promised, frames->num_read,
      frames->num_damaged == 0
          ? ""
          : fmt::format(", and {} between them cannot be decoded", frames->num_damaged));
}

std::string ScaleWarning(const std::vector<FrameRange>& ranges) {
  if (ranges.empty()) return "";
  return fmt::format(
      "the scale is uncertain in the frames {}: it may differ before and after them, as a large "
      "moving object or repetitive texture makes it; these frames have the reason "
      "scale_uncertain in frames.csv",
      RangesText(ranges));
}

int CountBlurredFrames(const Trajectory& trajectory) {
  constexpr int kOctavesOfBlur = 3;  // A factor of 1.7 with the default scale factor of 1.2.
  std::vector<int> octaves;
  for (const FrameResult& frame : trajectory.frames) {
    if (frame.finest_octave != kNoId) octaves.push_back(frame.finest_octave);
  }
  if (octaves.empty()) return 0;
  std::sort(octaves.begin(), octaves.end());
  const int sharp = octaves[octaves.size() / 10];
  return static_cast<int>(std::count_if(octaves.begin(), octaves.end(), [&](int octave) {
    return octave >= sharp + kOctavesOfBlur;
  }));
}

std::string BlurWarning(int num_blurred, int num_frames) {
  if (10 * num_blurred <= num_frames) return "";
  return fmt::format(
      "{} of {} frames are blurred: poses are less accurate there; use a shorter exposure time, or "
      "move more slowly",
      num_blurred, num_frames);
}

std::string ResidualWarning(const std::optional<MatchResiduals>& residuals) {
  if (!residuals || !IsImplausible(*residuals, {})) return "";
  return fmt::format(
      "the calibration is implausible: the median reprojection error of landmarks is at least "
      "{:.1f} px in every part of the sequence, at most {:.0f} px is expected; check the "
      "camera's focal length, principal point and distortion",
      residuals->least_part_px, residuals->max_median_px);
}

std::string FocalLengthWarning(const CalibrationCheck& check, double fx) {
  if (!check.is_implausible) return "";
  return fmt::format(
      "the calibration is implausible: {} of {} parts of the sequence, each alone, fit a focal "
      "length of about {:.0f} px, but fx is {:.0f} px; check the camera's focal length and "
      "distortion, or try --focal auto",
      check.num_agreeing, check.num_parts, check.focal_px, fx);
}

std::string MisfitWarning(const std::vector<MisfittingParameter>& parameters) {
  if (parameters.empty()) return "";
  std::string text;
  for (const MisfittingParameter& parameter : parameters) {
    const std::string name = parameter.name == "focal" ? "fx" : parameter.name;
    text += (text.empty() ? "" : ", ") +
            DifferenceText(name, parameter.fitted, parameter.sigma, "used", parameter.used);
  }
  return "the map fits another calibration than the given one: " + text;
}

std::string DisagreementWarning(const CalibrationReport& report) {
  if (report.is_consistent) return "";
  return "parts of the sequence disagree about the camera by more than their standard deviations "
         "allow: the given calibration is wrong, its lens is not of the given model, or it was "
         "zoomed or focused; the standard deviations were increased accordingly";
}

std::string EvidenceWarning(const CalibrationReport& report) {
  std::string text;
  for (const CalibrationReport::Estimate& e : report.estimates) {
    if (!e.is_contradicted) continue;
    text += (text.empty() ? "" : ", ") + DifferenceText(e.name, e.value, e.sigma, "given", e.given);
  }
  if (text.empty()) return "";
  return "the images are evidence against the given principal point or tangential distortion, "
         "which were estimated: " +
         text;
}

std::string ContradictionWarning(const CalibrationReport& report) {
  if (!report.prior_rejected) return "";
  return "the images contradict the given camera by more than its standard deviations allow; it "
         "was used as given: check its focal length and distortion, or increase their standard "
         "deviations (calibration.focal_sigma, k1_sigma, k2_sigma)";
}

}  // namespace corvo
