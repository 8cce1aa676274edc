// SPDX-License-Identifier: MIT
#include "apps/output/evaluation_table.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "apps/output/csv_field.h"
#include "apps/output/printable.h"
#include "vo/io/decimal_time.h"

namespace corvo {
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

using Row = std::vector<std::string>;

/// Returns the number of characters of a text in UTF-8.
std::size_t NumCharacters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string PosedText(const NamedEvaluation& result) {
  return result.num_frames ? fmt::format("{}/{}", result.num_poses, *result.num_frames)
                           : fmt::format("{}", result.num_poses);
}

std::string RmseText(const ErrorStatistics& errors) {
  return errors.count == 0 ? "-" : fmt::format("{:.4g}", errors.rmse);
}

void AddRelative(const std::string& span, const RelativeError& error, bool is_header, Row& row) {
  row.push_back(is_header ? fmt::format("RPE {} [m]", span) : RmseText(error.translation));
  row.push_back(is_header ? fmt::format("RPE {} [deg]", span) : RmseText(error.rotation_deg));
}

/// Adds the RPE of one result, or the names of its columns.
void AddRelative(const Evaluation& evaluation, bool is_header, Row& row) {
  const EvaluationOptions& options = evaluation.options;
  const int frames = options.relative_delta_frames;
  AddRelative(fmt::format("{} frame{}", frames, frames == 1 ? "" : "s"), evaluation.relative_frames,
              is_header, row);
  AddRelative(fmt::format("{:.6g} s", ToSeconds(options.relative_delta_ns)),
              evaluation.relative_time, is_header, row);
  if (!options.relative_delta_path) return;
  AddRelative(fmt::format("{:.6g} m", *options.relative_delta_path),
              evaluation.relative_path.value_or(RelativeError()), is_header, row);
}

/// Returns two rows: the names of the columns and their units.
std::vector<Row> HeaderOf(const NamedEvaluation& result, bool has_kitti) {
  Row row = {"result", "posed [frames]", "coverage [%]", "ATE [m]", "ATE [% of path]"};
  AddRelative(result.evaluation, true, row);
  if (has_kitti) row.insert(row.end(), {"t_rel [%]", "r_rel [deg/100 m]"});
  Row units;
  for (std::string& name : row) {
    const std::size_t end = std::min(name.find(" ["), name.size());
    units.push_back(end == name.size() ? "" : name.substr(end + 1));
    name.resize(end);
  }
  return {row, units};
}

Row RowOf(const NamedEvaluation& result, bool has_kitti) {
  const Evaluation& evaluation = result.evaluation;
  const bool has_path = evaluation.truth_path_length > 0;
  const double percent = 100 * evaluation.absolute.rmse / evaluation.truth_path_length;
  Row row = {Printable(result.name, true), PosedText(result),
             fmt::format("{:.1f}", 100 * evaluation.coverage), RmseText(evaluation.absolute),
             has_path ? fmt::format("{:.3f}", percent) : "-"};
  AddRelative(evaluation, false, row);
  if (!has_kitti) return row;
  const std::optional<KittiDrift>& drift = evaluation.kitti;
  row.push_back(drift ? fmt::format("{:.3f}", drift->t_rel_percent) : "-");
  row.push_back(drift ? fmt::format("{:.3f}", drift->r_rel_deg_per_100m) : "-");
  return row;
}

/// Returns the rows with columns of equal width: the first to the left, the others to the right.
std::string Aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], NumCharacters(row[i]));
    }
  }
  std::string text;
  for (const Row& row : rows) {
    text += row[0] + std::string(widths[0] - NumCharacters(row[0]), ' ');
    for (std::size_t i = 1; i < row.size(); ++i) {
      text += std::string(2 + widths[i] - NumCharacters(row[i]), ' ') + row[i];
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string EvaluationTable(const std::vector<NamedEvaluation>& results) {
  if (results.empty()) return "";
  const bool has_kitti = std::ranges::any_of(
      results, [](const NamedEvaluation& result) { return bool(result.evaluation.kitti); });
  std::vector<Row> rows = HeaderOf(results.front(), has_kitti);
  for (const NamedEvaluation& result : results) rows.push_back(RowOf(result, has_kitti));
  return Aligned(rows);
}

std::string PoseErrorTable(const std::vector<NamedEvaluation>& results) {
  const bool has_names = results.size() > 1;
  std::string text = has_names ? "result," : "";
  text += "timestamp,translation_error_m,rotation_error_deg\n";
  for (const NamedEvaluation& result : results) {
    const std::string name = has_names ? ToCsvField(result.name) + "," : "";
    const std::vector<PosePair>& pairs = result.evaluation.aligned_pairs;
    const std::vector<double> errors = PositionErrors(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const SO3 rotation = pairs[i].truth_from_camera.rotation().Inverse() *
                           pairs[i].estimate_from_camera.rotation();
      text += fmt::format("{}{},{:.9g},{:.9g}\n", name, FormatSeconds(pairs[i].time_ns), errors[i],
                          rotation.Angle() * kDegreesPerRadian);
    }
  }
  return text;
}

}  // namespace corvo
