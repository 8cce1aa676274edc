#include "apps/frame_tables.h"

#include <fmt/format.h>

namespace corvo {

std::string FormatSeconds(TimeNs time_ns) {
  constexpr TimeNs kSecond = 1'000'000'000;
  const char* sign = time_ns < 0 ? "-" : "";
  const TimeNs seconds = std::abs(time_ns / kSecond);
  return fmt::format("{}{}.{:09}", sign, seconds, std::abs(time_ns % kSecond));
}

std::string FrameTable(const Trajectory& trajectory) {
  std::string table =
      "index,timestamp,state,reason,segment,posed,features,matches,inliers,parallax\n";
  for (const FrameResult& frame : trajectory.frames) {
    table +=
        fmt::format("{},{},{},{},{},{},{},{},{},{:.6f}\n", frame.index,
                    FormatSeconds(frame.time_ns), ToString(frame.state), ToString(frame.reason),
                    frame.segment, frame.world_from_camera ? 1 : 0, frame.num_features,
                    frame.num_matches, frame.num_inliers, frame.parallax_deg);
  }
  return table;
}

std::string TimingTable(const std::vector<FrameTiming>& timings) {
  std::string table = "index,read_ms,extract_ms,track_ms,map_ms,adjust_ms,total_ms\n";
  for (std::size_t i = 0; i < timings.size(); ++i) {
    const FrameTiming& timing = timings[i];
    table += fmt::format("{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", i, timing.read_ms,
                         timing.stages.extract_ms, timing.stages.track_ms, timing.stages.map_ms,
                         timing.stages.adjust_ms, timing.total_ms);
  }
  return table;
}

}  // namespace corvo
