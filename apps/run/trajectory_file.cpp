// SPDX-License-Identifier: MIT
#include "apps/run/trajectory_file.h"

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/output/segment_report.h"
#include "vo/io/trajectory_io.h"

namespace corvo {
namespace {

/// Returns the poses of several segments in the order of the frames, with a comment wherever the
/// segment changes.
std::vector<CommentedPoses> MarkSegments(const std::vector<Segment>& segments,
                                         const Trajectory& trajectory) {
  std::map<int, std::string> comments;
  for (const Segment& segment : segments) comments[segment.index] = ToText(segment);
  std::vector<CommentedPoses> parts;
  int segment = kNoId;
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera) continue;
    if (parts.empty() || frame.segment != segment) {
      segment = frame.segment;
      parts.push_back({comments[segment], {}});
      comments[segment] = fmt::format("segment {}, continued", segment);
    }
    parts.back().poses.push_back({frame.time_ns, *frame.world_from_camera});
  }
  return parts;
}

}  // namespace

void WriteTrajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  const std::vector<Segment> segments = trajectory.Segments();
  if (segments.size() < 2) return WriteTum(file, trajectory.PosedFrames());
  WriteTumParts(file, MarkSegments(segments, trajectory));
}

}  // namespace corvo
