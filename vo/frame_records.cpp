#include "vo/frame_records.h"

namespace corvo {

void FrameRecords::SetPose(int frame, KeyframeId keyframe, const SE3& keyframe_from_camera) {
  records_[frame].keyframe = keyframe;
  records_[frame].from_camera = keyframe_from_camera;
}

void FrameRecords::SetRotation(int frame, int reference, const SO3& reference_from_camera) {
  records_[frame].reference = reference;
  records_[frame].from_camera = SE3(reference_from_camera, Eigen::Vector3d::Zero());
}

SE3 FrameRecords::PoseOf(int frame, const Map& map) const {
  const Record& record = records_[frame];
  return map.WorldFromKeyframe(record.keyframe) * record.from_camera;
}

std::optional<SO3> FrameRecords::RotationOf(int frame, const Map& map) const {
  SO3 ancestor_from_camera;
  for (int ancestor = frame;;) {
    const Record& record = records_[ancestor];
    if (IsPosed(ancestor)) return PoseOf(ancestor, map).rotation() * ancestor_from_camera;
    if (record.reference == kNoId) return std::nullopt;
    ancestor_from_camera = record.from_camera.rotation() * ancestor_from_camera;
    if (record.reference == ancestor) return ancestor_from_camera;
    ancestor = record.reference;
  }
}

FrameResult FrameRecords::ResultOf(int frame, const Map& map) const {
  FrameResult result{records_[frame].outcome, {}, {}};
  if (IsPosed(frame)) result.world_from_camera = PoseOf(frame, map);
  if (IsPosed(frame) || result.state == State::kRotationOnly) {
    result.world_from_camera_rotation = RotationOf(frame, map);
  }
  return result;
}

Trajectory FrameRecords::ToTrajectory(const Map& map) const {
  Trajectory trajectory;
  for (int frame = 0; frame < size(); ++frame) trajectory.frames.push_back(ResultOf(frame, map));
  return trajectory;
}

}  // namespace corvo
