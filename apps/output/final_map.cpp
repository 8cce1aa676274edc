// SPDX-License-Identifier: MIT
#include "apps/output/final_map.h"

#include <set>
#include <unordered_map>

#include "apps/output/observation_table.h"
#include "vo/offline/sequence_record.h"

namespace corvo {
namespace {

MapPoint MakePoint(LandmarkId id, const PointInSegment& point) {
  MapPoint made;
  made.id = id;
  made.segment = point.segment;
  made.in_world = point.in_world;
  return made;
}

/// Returns options for a record of the keyframes alone.
SequenceOptions KeyframesOnly() {
  SequenceOptions options;
  options.frames_between = 0;
  return options;
}

/// Returns the final observations of a frame: those of a keyframe are aligned when it is
/// marginalized, and are taken from the record of the keyframes.
FrameObservations FinalObservations(const FrameObservations& seen, const FrameResult& frame,
                                    const SequenceRecord& record) {
  const auto keyframe = record.frames().find({frame.segment, frame.index});
  if (keyframe != record.frames().end()) return keyframe->second.seen;
  return record.Finalize(seen, frame.segment);
}

}  // namespace

std::vector<MapPoint> CollectPoints(const LandmarkSpool& marginalized, const Map& map) {
  std::vector<MapPoint> points;
  marginalized.ForEach([&](const MarginalizedLandmark& landmark) {
    if (landmark.id < map.first_landmark_id()) return;  // Of a map that was discarded.
    const PointInSegment point{landmark.segment, landmark.in_world};
    points.push_back(MakePoint(landmark.id, ApplyJoins(map.joins(), landmark.num_joins, point)));
  });
  for (LandmarkId id = map.first_landmark_id(); id < map.num_landmark_ids(); ++id) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark == nullptr) continue;
    points.push_back(MakePoint(id, {landmark->segment, landmark->in_world}));
  }
  return points;
}

std::vector<MapPoint> CollectPoints(const Refinement& refinement) {
  std::vector<MapPoint> points;
  for (const MarginalizedLandmark& landmark : refinement.landmarks) {
    points.push_back(MakePoint(landmark.id, {landmark.segment, landmark.in_world}));
  }
  return points;
}

void WriteObservations(const Odometry& odometry, const ObservationLog& log,
                       const std::filesystem::path& file, std::vector<MapPoint>& points) {
  const SequenceRecord record(odometry, log, KeyframesOnly());
  const Trajectory trajectory = odometry.GetTrajectory();
  std::unordered_map<LandmarkId, MapPoint*> points_by_id;
  for (MapPoint& point : points) points_by_id[point.id] = &point;
  ObservationWriter writer(file);
  log.Visit([&](const FrameObservations& seen) {
    const FrameResult& frame = trajectory.frames[seen.frame];
    if (seen.keyframe != kNoId || !frame.world_from_camera) return;
    std::set<LandmarkId> written;  // Two keypoints may observe landmarks that were merged since.
    for (const Observation& o : FinalObservations(seen, frame, record).observations) {
      const auto point = points_by_id.find(o.landmark);
      if (point == points_by_id.end() || !written.insert(o.landmark).second) continue;
      ++point->second->num_observations;
      writer.Add({frame.index, o.landmark, static_cast<float>(o.pixel.x()),
                  static_cast<float>(o.pixel.y()), static_cast<float>(o.sigma_px)});
    }
  });
  writer.Finish();
}

}  // namespace corvo
