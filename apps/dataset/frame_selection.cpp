// SPDX-License-Identifier: MIT
#include "apps/dataset/frame_selection.h"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "apps/output/frame_tables.h"
#include "orb/error.h"

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

bool IsSelected(const FrameRow& row, const FrameSelection& selection) {
  const bool state_fits = selection.states.empty() ||
                          std::ranges::find(selection.states, row.state) != selection.states.end();
  return state_fits && (!selection.segment || row.segment == *selection.segment);
}

std::set<TimeNs> SelectTimes(const fs::path& file, const FrameSelection& selection) {
  std::set<TimeNs> times;
  for (const FrameRow& row : ReadFrameTable(file)) {
    if (IsSelected(row, selection)) times.insert(row.time_ns);
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
