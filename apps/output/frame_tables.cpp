// SPDX-License-Identifier: MIT
#include "apps/output/frame_tables.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/output/csv_field.h"
#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {

namespace {

constexpr const char* kFrameHeader =
    "index,timestamp,state,reason,segment,posed,features,matches,inliers,parallax,masked,"
    "window_adjustment,camera_adjustment,keyframe,found_share,image_coverage,distance_sigma,"
    "weakest_sigma,drift_sigma,image\n";

/// Returns the fields of a row; the last one, the name of the image, may hold commas.
std::vector<std::string> SplitRow(const std::string& row, std::size_t num_fields) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (fields.size() + 1 < num_fields) {
    const std::size_t comma = row.find(',', begin);
    if (comma == std::string::npos) break;
    fields.push_back(row.substr(begin, comma - begin));
    begin = comma + 1;
  }
  fields.push_back(row.substr(begin));
  return fields;
}

/// The number of columns and the indices of those that are read; the last two are optional.
struct Columns {
  std::size_t count = 0, time = 0, state = 0, segment = 0, keyframe = 0, image = 0;
};

Columns FindColumns(const std::string& header, const std::filesystem::path& file) {
  const std::vector<std::string> names = SplitFields(header);
  const auto find = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  for (const char* name : {"timestamp", "state", "segment"}) {
    if (find(name) < names.size()) continue;
    throw Error(
        fmt::format("{}: has no column {}; give the frames.csv of a run", file.string(), name));
  }
  return {names.size(),    find("timestamp"), find("state"),
          find("segment"), find("keyframe"),  find("image")};
}

FrameRow ParseRow(const std::vector<std::string>& fields, const Columns& columns,
                  const std::string& where) {
  if (fields.size() != columns.count) {
    throw Error(fmt::format("{}{} fields; the header has {}", where, fields.size(), columns.count));
  }
  FrameRow row;
  row.time_ns = ParseSeconds(fields[columns.time], where);
  row.state = fields[columns.state];
  row.segment = static_cast<int>(ParseNumber(fields[columns.segment], where));
  row.is_keyframe = columns.keyframe < columns.count && fields[columns.keyframe] == "1";
  if (columns.image < columns.count) row.image = FromCsvField(fields[columns.image]);
  return row;
}

}  // namespace

std::string FrameTable(const Trajectory& trajectory, const std::vector<std::string>& images) {
  std::string table = kFrameHeader;
  for (const FrameResult& frame : trajectory.frames) {
    const auto i = static_cast<std::size_t>(frame.index);
    const std::string image = i < images.size() ? ToCsvField(images[i]) : "";
    table += fmt::format(
        "{},{},{},{},{},{},{},{},{},{:.6f},{:.4f},{},{},{},"
        "{:.4f},{:.4f},{:.6g},{:.6g},{:.6g},{}\n",
        frame.index, FormatSeconds(frame.time_ns), ToString(frame.state), ToString(frame.reason),
        frame.segment, frame.world_from_camera ? 1 : 0, frame.num_features, frame.num_matches,
        frame.num_inliers, frame.parallax_deg, frame.masked_share,
        ToString(frame.window_adjustment), ToString(frame.camera_adjustment),
        frame.is_keyframe ? 1 : 0, frame.health.found_share, frame.health.image_coverage,
        frame.health.distance_sigma, frame.health.weakest_sigma, frame.health.drift_sigma, image);
  }
  return table;
}

std::string RelativePoseTable(const Trajectory& trajectory) {
  std::string table = "index,timestamp,reference,tx,ty,tz,qx,qy,qz,qw";
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) table += fmt::format(",c{}{}", row, column);
  }
  table += '\n';
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.relative_pose) continue;
    const RelativePose& relative = *frame.relative_pose;
    const SE3::Data data = relative.reference_from_camera.data();
    table += fmt::format("{},{},{}", frame.index, FormatSeconds(frame.time_ns), relative.reference);
    for (const int i : {4, 5, 6, 0, 1, 2, 3}) table += fmt::format(",{:.9g}", data[i]);
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) {
        table += fmt::format(",{:.10g}", relative.covariance(row, column));
      }
    }
    table += '\n';
  }
  return table;
}

std::vector<FrameRow> ReadFrameTable(const std::filesystem::path& file) {
  const std::vector<TextLine> lines = ReadTextLines(file);
  const Columns columns = FindColumns(lines.empty() ? "" : lines.front().text, file);
  std::vector<FrameRow> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = SplitRow(lines[i].text, columns.count);
    rows.push_back(ParseRow(fields, columns, LinePrefix(file, lines[i])));
    rows.back().index = static_cast<int>(i) - 1;
  }
  return rows;
}

std::string TimingTable(const std::vector<FrameTiming>& timings) {
  std::string table = "index,read_ms,extract_ms,locate_ms,map_ms,adjust_ms,total_ms,latency_ms\n";
  for (std::size_t i = 0; i < timings.size(); ++i) {
    const FrameTiming& timing = timings[i];
    table += fmt::format("{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},", i, timing.read_ms,
                         timing.stages.extract_ms, timing.stages.locate_ms, timing.stages.map_ms,
                         timing.stages.adjust_ms, timing.total_ms);
    if (timing.latency_ms) table += fmt::format("{:.3f}", *timing.latency_ms);
    table += '\n';
  }
  return table;
}

}  // namespace corvo
