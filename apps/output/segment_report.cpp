// SPDX-License-Identifier: MIT
#include "apps/output/segment_report.h"

#include <fmt/format.h>

namespace corvo {
namespace {

std::string ScaleText(const SegmentScale& scale) {
  const double percent = 100 * (scale.factor.value_or(1) - 1);
  switch (scale.source) {
    case ScaleSource::kCameraHeight:
      return fmt::format("in meters, scale from the height of the camera, ± {:.1f}%", percent);
    case ScaleSource::kKnownDistance:
      return "in meters, scale from the known distance";
    case ScaleSource::kKnownSize:
      return fmt::format("in meters, scale from the size of an object, ± {:.1f}%", percent);
    case ScaleSource::kArbitrary:
      return "scale arbitrary";
    case ScaleSource::kMedianSpeed:
      break;
  }
  return fmt::format(
      "scale guessed from the median speed before the loss, within a factor of {:.2g}",
      scale.factor.value_or(1));
}

nlohmann::ordered_json ScaleJson(const SegmentScale& scale) {
  nlohmann::ordered_json json = {{"from", ToString(scale.source)}, {"factor", nullptr}};
  if (scale.factor) json["factor"] = *scale.factor;
  return json;
}

}  // namespace

PoseSequence PosesOf(const Segment& segment, const Trajectory& trajectory) {
  PoseSequence poses;
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera || frame.segment != segment.index) continue;
    poses.push_back({frame.time_ns, *frame.world_from_camera});
  }
  return poses;
}

std::string ToText(const Segment& segment) {
  return fmt::format("segment {}: frames {}-{}, {} pose{}, {}", segment.index, segment.first_frame,
                     segment.last_frame, segment.num_poses, segment.num_poses == 1 ? "" : "s",
                     ScaleText(segment.scale));
}

nlohmann::ordered_json ToJson(const std::vector<Segment>& segments) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Segment& segment : segments) {
    json.push_back({{"index", segment.index},
                    {"first_frame", segment.first_frame},
                    {"last_frame", segment.last_frame},
                    {"num_poses", segment.num_poses},
                    {"scale", ScaleJson(segment.scale)}});
  }
  return json;
}

}  // namespace corvo
