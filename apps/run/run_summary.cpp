// SPDX-License-Identifier: MIT
#include "apps/run/run_summary.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/output/calibration_report.h"
#include "apps/output/evaluation_report.h"
#include "apps/output/reasons.h"
#include "apps/output/segment_report.h"
#include "apps/run/image_names.h"
#include "apps/run/kitti_trajectory.h"
#include "apps/run/stated_focal.h"
#include "orb/error.h"
#include "orb/pyramid.h"
#include "vo/offline/expected_drift.h"

namespace corvo {
namespace {

/// The version of the layout of summary.json and of the files beside it.
constexpr int kSchemaVersion = 2;

using Json = nlohmann::ordered_json;

double Share(int part, int whole) { return whole == 0 ? 0.0 : static_cast<double>(part) / whole; }

Json CameraJson(const CameraParameters& camera) {
  Json json = {{"model", ToString(camera.model)}};
  CameraParameters::Visit(
      camera, [&json](const char* name, const auto& value, auto&&...) { json[name] = value; });
  return json;
}

template <typename Key>
Json CountsJson(const std::map<Key, int>& counts) {
  Json json = Json::object();
  for (const auto& [key, count] : counts) json[std::string(ToString(key))] = count;
  return json;
}

/// Returns the reasons, the most frequent first.
std::vector<std::pair<Reason, int>> ByCount(const std::map<Reason, int>& reasons) {
  std::vector<std::pair<Reason, int>> sorted(reasons.begin(), reasons.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

/// Returns how much was excluded because it moves with the camera; empty if it is hardly anything.
std::string OverlayText(const RunSummary& summary) {
  constexpr double kMinShare = 0.01;
  if (summary.masked_share < kMinShare) return "";
  return fmt::format("{:.0f}% of the image area moves with the camera and was excluded\n",
                     100 * summary.masked_share);
}

/// Returns one line for each segment if there are several or their scale was measured.
std::string SegmentsText(const RunSummary& summary) {
  std::string text;
  const bool is_measured = std::ranges::any_of(
      summary.segments, [](const Segment& segment) { return IsMetric(segment.scale.source); });
  if (summary.segments.size() < 2 && !is_measured) return text;
  for (const Segment& segment : summary.segments) text += ToText(segment) + "\n";
  return text;
}

/// Returns a histogram of the reasons, with advice on each.
std::string ReasonsText(const RunSummary& summary) {
  constexpr int kBarColumns = 20;
  if (summary.reasons.empty()) return "";
  const int unposed = summary.num_frames - summary.num_posed;
  std::string text = fmt::format("{} of {} frames have no pose:\n", unposed, summary.num_frames);
  for (const auto& [reason, count] : ByCount(summary.reasons)) {
    const int columns = std::max(1, count * kBarColumns / unposed);
    text += fmt::format("  {:<18} {:>6}  {:<{}}  {}\n", ToString(reason), count,
                        std::string(columns, '#'), kBarColumns, Advice(reason));
  }
  return text;
}

std::optional<MatchResiduals> Measure(const Odometry& odometry) {
  MatchResidualOptions options;
  options.max_distance = odometry.options().matching.max_distance;
  return MeasureResiduals(odometry.map(), options);
}

/// Collects and logs what is doubtful about the result.
void Warn(const RunRecord& record, RunSummary& summary) {
  const Map& map = record.odometry.map();
  for (const std::string& warning :
       {MissingImageWarning(Reason::kUnreadableImage, summary.reasons, record.first_errors),
        MissingImageWarning(Reason::kWrongSize, summary.reasons, record.first_errors),
        VideoWarning(summary.video), ScaleWarning(summary.uncertain_scale),
        BlurWarning(summary.num_blurred, summary.num_frames), ResidualWarning(summary.residuals),
        FocalLengthWarning(summary.check, map.camera().fx()),
        DisagreementWarning(summary.calibration), EvidenceWarning(summary.calibration),
        ContradictionWarning(summary.calibration), MisfitWarning(summary.misfitting),
        record.why_not_metric}) {
    if (warning.empty()) continue;
    spdlog::warn("{}", warning);
    summary.warnings.push_back(warning);
  }
}

std::string CameraSource(const RunArguments& arguments) {
  if (arguments.focal == kAutoFocal) return "focal search";
  if (!arguments.focal.empty()) return "--focal " + arguments.focal;
  if (arguments.fov_deg) return fmt::format("--fov {}", *arguments.fov_deg);
  return arguments.camera.empty() ? "dataset" : arguments.camera.string();
}

Json PathOrNull(const std::filesystem::path& path) {
  return path.empty() ? Json() : Json(path.string());
}

Json ToJson(const GrayLevels& levels) {
  if (levels.bits()) return {{"bits", *levels.bits()}};
  return {{"low", levels.low()}, {"high", levels.high()}};
}

/// Adds where the images come from, and those of --start, --every, --count, --resize, --mask,
/// --fps, --times, --bits and --topic that were given.
void AddInputJson(const RunArguments& arguments, const ImageSource& source, Json& json) {
  const std::filesystem::path& input = arguments.input;
  const ImageNames names(input, source.list());
  json["input"] = (source.is_live() ? input : std::filesystem::absolute(input)).string();
  json["image_folder"] = PathOrNull(names.folder());
  json["video"] = PathOrNull(names.video());
  json["layout"] = source.list().layout;
  const Selection& selection = arguments.selection;
  if (selection.start != 0) json["start"] = selection.start;
  if (selection.every != 1) json["every"] = selection.every;
  if (selection.count) json["count"] = *selection.count;
  if (!arguments.resize.empty()) json["resize"] = arguments.resize;
  if (!arguments.mask.empty()) json["mask"] = std::filesystem::absolute(arguments.mask).string();
  const InputOptions& stored = arguments.stored;
  if (stored.frame_rate_hz) json["fps"] = *stored.frame_rate_hz;
  if (!stored.times.empty()) json["times"] = std::filesystem::absolute(stored.times).string();
  if (stored.bits) json["bits"] = *stored.bits;
  if (!stored.topic.empty()) json["topic"] = stored.topic;
  if (const auto levels = source.gray_levels()) json["gray_levels"] = ToJson(*levels);
}

/// Returns std::nullopt and logs a warning if there are too few poses to be compared.
std::optional<Evaluation> TryEvaluate(const PoseSequence& estimate, const PoseSequence& truth,
                                      const EvaluationOptions& options) {
  try {
    return Evaluate(estimate, truth, options);
  } catch (const Error& error) {
    spdlog::warn("the trajectory was not evaluated: {}", error.what());
    return std::nullopt;
  }
}

std::optional<TimeNs> MaxDt(const RunArguments& arguments) {
  if (!arguments.max_dt_s) return std::nullopt;
  return std::llround(1e9 * *arguments.max_dt_s);
}

/// Evaluates relative rotations, which need no alignment and exist for frames without a pose, too.
/// Returns std::nullopt if no rotations can be compared.
std::optional<ErrorStatistics> EvaluateRotations(const PoseSequence& rotations,
                                                 const PoseSequence& truth,
                                                 std::optional<TimeNs> max_dt_ns) {
  constexpr TimeNs kSecond = 1'000'000'000;
  const auto pairs = Associate(rotations, truth, max_dt_ns.value_or(HalfFrame(rotations)));
  const ErrorStatistics errors = RelativeErrorOverTime(pairs, kSecond).rotation_deg;
  return errors.count > 0 ? std::optional(errors) : std::nullopt;
}

void CountFrames(const Trajectory& trajectory, RunSummary& summary) {
  summary.num_frames = static_cast<int>(trajectory.frames.size());
  summary.num_posed = CountPosedFrames(trajectory);
  summary.num_rotations = static_cast<int>(trajectory.Rotations().size());
  summary.segments = trajectory.Segments();
  summary.reasons = CountReasons(trajectory);
  for (const FrameResult& frame : trajectory.frames) {
    ++summary.states[frame.state];
    summary.num_repeated += frame.repeats != kNoId;
    summary.masked_share += frame.masked_share / static_cast<double>(trajectory.frames.size());
    ++summary.window_adjustments[frame.window_adjustment];
    ++summary.camera_adjustments[frame.camera_adjustment];
  }
  summary.window_adjustments.erase(AdjustmentStatus::kNone);
  summary.camera_adjustments.erase(AdjustmentStatus::kNone);
}

/// Sets what the covariances let expect of the error of the trajectory.
void ExpectDrift(const Trajectory& trajectory, RunSummary& summary) {
  double path = 0;  // Not across segments.
  for (const Segment& segment : trajectory.Segments()) {
    path += PathLength(PosesOf(segment, trajectory));
  }
  summary.expected_ate = ExpectedAte(trajectory);
  if (path > 0) summary.expected_ate_of_path = summary.expected_ate / path;
  summary.least_certain = LeastCertainRanges(trajectory);
}

/// Returns what to expect of the error of the trajectory.
std::string DriftText(const RunSummary& summary) {
  if (summary.expected_ate == 0) return "";
  std::string text = fmt::format("expected ATE           {:.2g}% of the path at least\n",
                                 100 * summary.expected_ate_of_path);
  if (summary.least_certain.empty()) return text;
  return text + fmt::format("least certain frames   {}\n", RangesText(summary.least_certain));
}

Json ToJson(const MatchResiduals& residuals, const CalibrationCheck& check) {
  return {{"matches", residuals.num_matches},
          {"median_px", residuals.median_px},
          {"parts", check.num_parts},
          {"parts_with_other_fx", check.num_agreeing},
          {"fx_of_parts", check.focal_px},
          {"implausible_calibration", check.is_implausible || IsImplausible(residuals)}};
}

Json ToJson(const VideoFrames& frames) {
  Json json = {{"frames_promised", nullptr},
               {"frames_read", frames.num_read},
               {"frames_damaged", frames.num_damaged}};
  if (frames.num_promised > 0) json["frames_promised"] = frames.num_promised;
  return json;
}

Json ToJson(const std::vector<FrameRange>& ranges) {
  Json json = Json::array();
  for (const FrameRange& range : ranges) json.push_back({range.first, range.last});
  return json;
}

void AddEndJson(const RunSummary& summary, Json& json) {
  const bool is_complete = summary.end.is_complete();
  json["complete"] = is_complete;
  if (!is_complete) json["ended_by"] = summary.end.why;
  json["outcome"] = is_complete ? ToString(summary.outcome) : "incomplete";
  json["exit_code"] = is_complete ? static_cast<int>(summary.outcome) : summary.end.exit_code;
}

void AddCountsJson(const RunSummary& summary, Json& json) {
  json["frames"] = summary.num_frames;
  json["frames_expected"] = nullptr;
  if (summary.num_expected) json["frames_expected"] = *summary.num_expected;
  if (summary.video) json["video_frames"] = ToJson(*summary.video);
  json["posed"] = summary.num_posed;
  json["posed_share"] = Share(summary.num_posed, summary.num_frames);
  json["rotations"] = summary.num_rotations;
  json["repeated"] = summary.num_repeated;
  json["masked_share"] = summary.masked_share;
  json["blurred"] = summary.num_blurred;
  json["scale_uncertain"] = ToJson(summary.uncertain_scale);
  json["expected_ate"] = {{"rmse", summary.expected_ate},
                          {"percent_of_path", 100 * summary.expected_ate_of_path}};
  json["least_certain"] = ToJson(summary.least_certain);
  json["segments"] = ToJson(summary.segments);
  json["keyframes"] = summary.num_keyframes;
  json["landmarks"] = summary.num_landmarks;
  if (summary.residuals) json["residuals"] = ToJson(*summary.residuals, summary.check);
  json["states"] = CountsJson(summary.states);
  json["reasons"] = CountsJson(summary.reasons);
  json["adjustments"] = {{"window", CountsJson(summary.window_adjustments)},
                         {"camera", CountsJson(summary.camera_adjustments)}};
}

}  // namespace

RunSummary Summarize(const RunArguments& arguments, const RunInputs& inputs,
                     const RunRecord& record) {
  const Trajectory& trajectory = record.trajectory;
  const Map& map = record.odometry.map();
  RunSummary summary;
  summary.outcome = JudgeOutcome(trajectory);
  summary.end = record.end;
  summary.num_expected = inputs.source.size();
  summary.video = inputs.source.video_frames();
  CountFrames(trajectory, summary);
  summary.num_keyframes = map.num_keyframes();
  summary.num_landmarks = record.finished->size() + map.num_landmarks();
  summary.why_not_kitti = WhyNotKitti(trajectory);
  summary.residuals = Measure(record.odometry);
  summary.check = record.check;
  summary.misfitting = FindMisfittingParameters(map);
  summary.calibration = ReportCalibration(record.odometry, record.refinement);
  if (record.refinement) summary.refinement = ReportRefinement(*record.refinement);
  summary.uncertain_scale = UncertainScaleRanges(trajectory);
  summary.num_blurred = CountBlurredFrames(trajectory);
  ExpectDrift(trajectory, summary);
  Warn(record, summary);
  if (!inputs.truth.poses.empty()) {
    EvaluationOptions options;
    options.max_dt_ns = MaxDt(arguments);
    summary.evaluation = TryEvaluate(trajectory.PosedFrames(), inputs.truth.poses, options);
    summary.rotation_deg =
        EvaluateRotations(trajectory.Rotations(), inputs.truth.poses, MaxDt(arguments));
  }
  return summary;
}

Json ToJson(const RunArguments& arguments, const RunInputs& inputs, const RunSummary& summary) {
  Json json;
  json["schema"] = kSchemaVersion;
  AddEndJson(summary, json);
  AddInputJson(arguments, inputs.source, json);
  json["camera_source"] = CameraSource(arguments);
  json["camera"] = CameraJson(inputs.camera.given);
  json["warnings"] = inputs.warnings;
  for (const std::string& warning : summary.warnings) json["warnings"].push_back(warning);
  json["calibration"] = ToJson(summary.calibration);
  if (summary.refinement) json["refinement"] = ToJson(*summary.refinement);
  AddCountsJson(summary, json);
  json["trajectory_kitti"] =
      summary.why_not_kitti.empty() ? "written" : "not written: " + summary.why_not_kitti;
  if (arguments.meters_per_unit) json["meters_per_unit"] = *arguments.meters_per_unit;
  if (arguments.camera_height_m) json["camera_height"] = *arguments.camera_height_m;
  if (!arguments.known_distances.empty()) json["known_distance"] = arguments.known_distances;
  if (!arguments.known_sizes.empty()) json["known_size"] = arguments.known_sizes;
  if (!inputs.truth.file.empty()) json["truth"] = inputs.truth.file.string();
  if (summary.evaluation) json["evaluation"] = ToJson(*summary.evaluation);
  if (summary.rotation_deg) json["rotation_over_1s_deg"] = ToJson(*summary.rotation_deg);
  return json;
}

std::string SummaryText(const RunArguments& arguments, const RunSummary& summary) {
  std::string text = fmt::format(
      "{}: {} frames, {} posed ({:.1f}%), {} segment{}, {} keyframes, {} landmarks\n",
      ToString(summary.outcome), summary.num_frames, summary.num_posed,
      100 * Share(summary.num_posed, summary.num_frames), summary.segments.size(),
      summary.segments.size() == 1 ? "" : "s", summary.num_keyframes, summary.num_landmarks);
  text += SegmentsText(summary) + OverlayText(summary) + ReasonsText(summary) +
          ToText(summary.calibration) + DriftText(summary);
  if (summary.refinement) text += ToText(*summary.refinement);
  if (summary.evaluation) text += ToText(*summary.evaluation);
  if (summary.rotation_deg && summary.num_rotations > summary.num_posed) {
    text += ToText(fmt::format("{} rotations, 1 s", summary.num_rotations), *summary.rotation_deg,
                   " deg");
  }
  for (const char* name : {"trajectory.tum", "frames.csv", "summary.json", "trajectory.png"}) {
    const std::filesystem::path file = arguments.output / name;
    if (std::filesystem::exists(file)) text += file.string() + "\n";
  }
  return text;
}

}  // namespace corvo
