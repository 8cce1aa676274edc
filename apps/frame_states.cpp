#include "apps/frame_states.h"

#include <algorithm>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/decimal_time.h"
#include "vo/text_lines.h"

namespace corvo {
namespace {

/// Column `name` of the header.
std::size_t FindColumn(const std::vector<std::string>& header, const char* name,
                       const std::filesystem::path& file) {
  const auto column = std::find(header.begin(), header.end(), name);
  if (column != header.end()) return static_cast<std::size_t>(column - header.begin());
  throw Error(
      fmt::format("{}: has no column {}; give the frames.csv of a run", file.string(), name));
}

std::map<TimeNs, std::string> ReadStates(const std::filesystem::path& file) {
  const std::vector<TextLine> lines = ReadTextLines(file);
  const std::vector<std::string> header =
      lines.empty() ? std::vector<std::string>() : SplitFields(lines.front().text, ',');
  const std::size_t time_column = FindColumn(header, "timestamp", file);
  const std::size_t state_column = FindColumn(header, "state", file);
  std::map<TimeNs, std::string> states;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string where = LinePrefix(file, lines[i]);
    const std::vector<std::string> fields = SplitFields(lines[i].text, ',');
    if (fields.size() != header.size()) {
      throw Error(
          fmt::format("{}{} fields; the header has {}", where, fields.size(), header.size()));
    }
    states[ParseSeconds(fields[time_column], where)] = fields[state_column];
  }
  return states;
}

/// The names of all states.
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
    throw Error(fmt::format("\"{}\" is no state; there are {}", state, fmt::join(names, ", ")));
  }
}

}  // namespace

PoseSequence SelectStates(const PoseSequence& poses, const std::filesystem::path& frames_csv,
                          const std::vector<std::string>& states) {
  CheckStates(states);
  const std::map<TimeNs, std::string> state_of_frame = ReadStates(frames_csv);
  PoseSequence selected;
  for (const TimedPose& pose : poses) {
    const auto state = state_of_frame.find(pose.time_ns);
    if (state == state_of_frame.end()) continue;
    if (std::find(states.begin(), states.end(), state->second) != states.end()) {
      selected.push_back(pose);
    }
  }
  return selected;
}

}  // namespace corvo
