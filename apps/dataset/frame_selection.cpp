// SPDX-License-Identifier: MIT
#include "apps/dataset/frame_selection.h"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns the names of all states.
std::vector<std::string_view> StateNames() {
  std::vector<std::string_view> names;
  for (int state = 0; ToString(static_cast<State>(state)) != "unknown"; ++state) {
    names.push_back(ToString(static_cast<State>(state)));
  }
  return names;
}

void CheckStates(const std::vector<std::string>& states) {
  const std::vector<std::string_view> names = StateNames();
  for (const std::string& state : states) {
    if (std::find(names.begin(), names.end(), state) != names.end()) continue;
    throw Error(
        fmt::format("\"{}\" is not a state; the states are {}", state, fmt::join(names, ", ")));
  }
}

/// Returns the index of the column `name` of the header. Throws corvo::Error if there is none.
std::size_t FindColumn(const std::vector<std::string>& header, const char* name,
                       const fs::path& file) {
  const auto column = std::find(header.begin(), header.end(), name);
  if (column != header.end()) return static_cast<std::size_t>(column - header.begin());
  throw Error(
      fmt::format("{}: has no column {}; give the frames.csv of a run", file.string(), name));
}

/// The number of columns of frames.csv and the indices of those that are used.
struct Columns {
  std::size_t count = 0, time = 0, state = 0, segment = 0;
};

Columns FindColumns(const std::vector<TextLine>& lines, const fs::path& file) {
  const std::vector<std::string> header =
      lines.empty() ? std::vector<std::string>() : SplitFields(lines.front().text);
  return {header.size(), FindColumn(header, "timestamp", file), FindColumn(header, "state", file),
          FindColumn(header, "segment", file)};
}

bool IsSelected(const std::vector<std::string>& fields, const Columns& columns,
                const FrameSelection& selection) {
  const std::vector<std::string>& states = selection.states;
  const bool state_fits = states.empty() || std::find(states.begin(), states.end(),
                                                      fields[columns.state]) != states.end();
  const bool segment_fits =
      !selection.segment || fields[columns.segment] == std::to_string(*selection.segment);
  return state_fits && segment_fits;
}

std::set<TimeNs> SelectTimes(const fs::path& file, const FrameSelection& selection) {
  const std::vector<TextLine> lines = ReadTextLines(file);
  const Columns columns = FindColumns(lines, file);
  std::set<TimeNs> times;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string where = LinePrefix(file, lines[i]);
    const std::vector<std::string> fields = SplitFields(lines[i].text);
    if (fields.size() != columns.count) {
      throw Error(
          fmt::format("{}{} fields; the header has {}", where, fields.size(), columns.count));
    }
    if (!IsSelected(fields, columns, selection)) continue;
    times.insert(ParseSeconds(fields[columns.time], where));
  }
  return times;
}

}  // namespace

PoseSequence SelectFrames(const PoseSequence& poses, const fs::path& frames_csv,
                          const FrameSelection& selection) {
  CheckStates(selection.states);
  const std::set<TimeNs> times = SelectTimes(frames_csv, selection);
  PoseSequence selected;
  for (const TimedPose& pose : poses) {
    if (times.count(pose.time_ns) > 0) selected.push_back(pose);
  }
  return selected;
}

}  // namespace corvo
