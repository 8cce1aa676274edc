// SPDX-License-Identifier: MIT
#include "apps/output/frame_tables.h"

#include <fmt/format.h>

#include "vo/io/decimal_time.h"

namespace corvo {

std::string FrameTable(const Trajectory& trajectory) {
  std::string table =
      "index,timestamp,state,reason,segment,posed,features,matches,inliers,parallax,masked,"
      "window_adjustment,camera_adjustment\n";
  for (const FrameResult& frame : trajectory.frames) {
    table +=
        fmt::format("{},{},{},{},{},{},{},{},{},{:.6f},{:.4f},{},{}\n", frame.index,
                    FormatSeconds(frame.time_ns), ToString(frame.state), ToString(frame.reason),
                    frame.segment, frame.world_from_camera ? 1 : 0, frame.num_features,
                    frame.num_matches, frame.num_inliers, frame.parallax_deg, frame.masked_share,
                    ToString(frame.window_adjustment), ToString(frame.camera_adjustment));
  }
  return table;
}

std::string TimingTable(const std::vector<FrameTiming>& timings) {
  std::string table = "index,read_ms,extract_ms,locate_ms,map_ms,adjust_ms,total_ms\n";
  for (std::size_t i = 0; i < timings.size(); ++i) {
    const FrameTiming& timing = timings[i];
    table += fmt::format("{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", i, timing.read_ms,
                         timing.stages.extract_ms, timing.stages.locate_ms, timing.stages.map_ms,
                         timing.stages.adjust_ms, timing.total_ms);
  }
  return table;
}

}  // namespace corvo
