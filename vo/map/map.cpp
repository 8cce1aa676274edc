// SPDX-License-Identifier: MIT
#include "vo/map/map.h"

#include <algorithm>
#include <utility>

#include "orb/hamming.h"

namespace corvo {
namespace {

std::vector<TrackElement>::const_iterator FindTrackElement(const Landmark& landmark,
                                                           KeyframeId keyframe) {
  return std::find_if(landmark.track.begin(), landmark.track.end(),
                      [&](const TrackElement& o) { return o.keyframe == keyframe; });
}

/// Returns the index of the descriptor with the least median distance to all others (the first one
/// in case of a tie).
int FindMedoid(const std::vector<orb::Descriptor>& descriptors) {
  const int n = static_cast<int>(descriptors.size());
  int best = 0;
  int best_median = 257;
  std::vector<int> distances(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      distances[j] = orb::HammingDistance(descriptors[i], descriptors[j]);
    }
    std::nth_element(distances.begin(), distances.begin() + (n - 1) / 2, distances.end());
    if (distances[(n - 1) / 2] < best_median) {
      best_median = distances[(n - 1) / 2];
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<KeyframeId> FirstKeyframes(const std::vector<Covisible>& covisible, int max_count) {
  std::vector<KeyframeId> keyframes;
  for (const Covisible& entry : covisible) {
    if (static_cast<int>(keyframes.size()) == max_count) break;
    keyframes.push_back(entry.keyframe);
  }
  return keyframes;
}

std::vector<KeyframeId> Map::ActiveKeyframes() const {
  std::vector<KeyframeId> kept;
  for (const auto& [id, keyframe] : keyframes_) kept.push_back(id);
  std::sort(kept.begin(), kept.end());
  return kept;
}

SE3 Map::WorldFromKeyframe(KeyframeId id) const {
  SE3 current_from_keyframe;
  while (keyframe_poses_[id].anchor != kNoId) {
    current_from_keyframe = keyframe_poses_[id].pose * current_from_keyframe;
    id = keyframe_poses_[id].anchor;
  }
  const SE3& world_from_current =
      IsActive(id) ? keyframe(id).frame.world_from_camera : keyframe_poses_[id].pose;
  return world_from_current * current_from_keyframe;
}

int Map::NewestSegment() const {
  int newest = kNoId;
  for (const KeyframePose& pose : keyframe_poses_) newest = std::max(newest, pose.segment);
  return newest;
}

bool Map::IsMovable(int segment) const {
  for (KeyframeId id = 0; id < num_keyframes(); ++id) {
    if (SegmentOf(id) == segment && !IsActive(id) && !IsCulled(id)) return false;
  }
  return true;
}

void Map::JoinSegments(const SegmentJoin& join) {
  const double scale = join.earlier_from_later.scale();
  for (KeyframePose& pose : keyframe_poses_) {
    if (pose.segment != join.later) continue;
    pose.segment = join.earlier;
    pose.pose = SE3(pose.pose.rotation(), scale * pose.pose.translation());  // Of culled ones.
  }
  for (auto& [id, keyframe] : keyframes_) {
    if (keyframe.segment != join.later) continue;
    keyframe.segment = join.earlier;
    SE3& pose = keyframe.frame.world_from_camera;
    pose = TransformPose(join.earlier_from_later, pose);
  }
  for (auto& [id, landmark] : landmarks_) {
    if (landmark.segment != join.later) continue;
    landmark.segment = join.earlier;
    landmark.in_world = join.earlier_from_later * landmark.in_world;
    landmark.view_direction = join.earlier_from_later.rotation() * landmark.view_direction;
    landmark.max_distance *= scale;
  }
  joins_.push_back(join);
}

const Landmark* Map::FindLandmark(LandmarkId id) const {
  const auto found = landmarks_.find(id);
  return found == landmarks_.end() ? nullptr : &found->second;
}

LandmarkId Map::Resolve(LandmarkId id) const {
  while (id != kNoId && FindLandmark(id) == nullptr) {
    const auto merged = merged_into_.find(id);
    id = merged == merged_into_.end() ? kNoId : merged->second;
  }
  return id;
}

KeyframeId Map::AddKeyframe(Frame frame, int segment) {
  const KeyframeId id = num_keyframes();
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] == kNoId) continue;
    landmarks_.at(frame.landmarks[k]).track.push_back({id, k});
  }
  KeyframePose pose;
  pose.segment = segment;
  keyframe_poses_.push_back(pose);
  keyframes_[id] = {id, segment, std::move(frame)};
  return id;
}

void Map::CullKeyframe(KeyframeId id, KeyframeId anchor) {
  for (const LandmarkId landmark : LandmarksOf(id)) {
    if (FindLandmark(landmark) != nullptr) RemoveTrackElement(landmark, id);
  }
  keyframe_poses_[id].pose =
      WorldFromKeyframe(anchor).Inverse() * keyframe(id).frame.world_from_camera;
  keyframe_poses_[id].anchor = anchor;
  keyframes_.erase(id);
}

std::vector<MarginalizedLandmark> Map::MarginalizeKeyframe(KeyframeId id) {
  std::vector<MarginalizedLandmark> finished;
  for (const LandmarkId landmark_id : LandmarksOf(id)) {
    const Landmark& landmark = landmarks_.at(landmark_id);
    if (landmark.track.size() <= 2) {
      finished.push_back({landmark_id, landmark.segment, landmark.in_world, num_joins()});
    }
    RemoveTrackElement(landmark_id, id);
  }
  keyframe_poses_[id].pose = keyframe(id).frame.world_from_camera;
  keyframes_.erase(id);
  return finished;
}

void Map::DropPatches(KeyframeId id) {
  const auto found = keyframes_.find(id);
  if (found != keyframes_.end()) std::vector<orb::Patch>().swap(found->second.frame.patches);
}

void Map::UpdateRays(KeyframeId id) { corvo::UpdateRays(model_.camera, keyframes_.at(id).frame); }

void Map::SetPose(KeyframeId id, const SE3& world_from_camera) {
  keyframes_.at(id).frame.world_from_camera = world_from_camera;
}

/// Returns the reference of a landmark. By definition the keypoint lies where its own patch puts
/// it, so it counts as aligned.
Reference Map::MakeReference(const TrackElement& observation) {
  Frame& frame = keyframes_.at(observation.keyframe).frame;
  const int k = observation.keypoint;
  Reference reference;
  reference.keyframe = observation.keyframe;
  reference.octave = frame.keypoint(k).octave;
  if (frame.patches.empty()) return reference;
  reference.patch = frame.patches[k];
  reference.offset_px = frame.pixel(k) - frame.detected_pixel(k);
  frame.is_aligned[k] = 1;
  return reference;
}

LandmarkId Map::AddLandmark(const Eigen::Vector3d& in_world,
                            std::vector<TrackElement> observations) {
  const LandmarkId id = num_landmark_ids_++;
  Landmark& landmark = landmarks_[id];
  landmark.id = id;
  landmark.segment = SegmentOf(observations.front().keyframe);
  landmark.in_world = in_world;
  landmark.newest_keyframe = num_keyframes() - 1;
  landmark.num_visible = landmark.num_found = static_cast<int>(observations.size());
  landmark.reference = MakeReference(observations.front());
  for (const TrackElement& observation : observations) AddTrackElement(id, observation);
  return id;
}

void Map::SetPixel(const TrackElement& observation, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& ray) {
  Frame& frame = keyframes_.at(observation.keyframe).frame;
  frame.pixels[observation.keypoint] = pixel;
  frame.rays[observation.keypoint] = ray;
  frame.is_aligned[observation.keypoint] = 1;
}

void Map::SetPosition(LandmarkId id, const Eigen::Vector3d& in_world) {
  landmarks_.at(id).in_world = in_world;
}

void Map::RemoveLandmark(LandmarkId id) {
  for (const TrackElement& o : landmarks_.at(id).track) {
    keyframes_.at(o.keyframe).frame.landmarks[o.keypoint] = kNoId;
  }
  landmarks_.erase(id);
}

void Map::MergeLandmark(LandmarkId from, LandmarkId into) {
  const Landmark old = landmarks_.at(from);
  RemoveLandmark(from);
  merged_into_[from] = into;
  merges_.push_back({num_keyframes() - 1, from});
  Landmark& merged = landmarks_.at(into);
  merged.num_visible += old.num_visible;
  merged.num_found += old.num_found;
  for (const TrackElement& o : old.track) {
    if (FindTrackElement(merged, o.keyframe) == merged.track.end()) AddTrackElement(into, o);
  }
}

void Map::ForgetMergesBefore(KeyframeId keyframe) {
  while (!merges_.empty() && merges_.front().newest_keyframe < keyframe) {
    merged_into_.erase(merges_.front().from);
    merges_.pop_front();
  }
}

void Map::CountSeen(const std::vector<LandmarkId>& visible, const Frame& frame) {
  for (const LandmarkId id : visible) {
    const auto landmark = landmarks_.find(id);
    if (landmark != landmarks_.end()) ++landmark->second.num_visible;
  }
  for (const LandmarkId id : frame.landmarks) {
    if (id != kNoId) ++landmarks_.at(id).num_found;
  }
}

void Map::AddTrackElement(LandmarkId id, const TrackElement& observation) {
  std::vector<TrackElement>& observations = landmarks_.at(id).track;
  const auto later = std::find_if(observations.begin(), observations.end(),
                                  [&](const auto& o) { return o.keyframe > observation.keyframe; });
  observations.insert(later, observation);
  keyframes_.at(observation.keyframe).frame.landmarks[observation.keypoint] = id;
}

void Map::RemoveTrackElement(LandmarkId id, KeyframeId keyframe) {
  Landmark& landmark = landmarks_.at(id);
  const auto found = FindTrackElement(landmark, keyframe);
  if (found == landmark.track.end()) return;
  keyframes_.at(keyframe).frame.landmarks[found->keypoint] = kNoId;
  landmark.track.erase(found);
  if (landmark.track.size() < 2) RemoveLandmark(id);
}

void Map::UpdateAppearance(LandmarkId id) {
  Landmark& landmark = landmarks_.at(id);
  std::vector<orb::Descriptor> descriptors;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const TrackElement& o : landmark.track) {
    const Frame& frame = keyframe(o.keyframe).frame;
    descriptors.push_back(frame.descriptor(o.keypoint));
    sum += (landmark.in_world - frame.world_from_camera.translation()).normalized();
  }
  landmark.descriptor = descriptors[FindMedoid(descriptors)];
  landmark.view_direction = sum.normalized();
  const TrackElement& first = landmark.track.front();
  const Frame& frame = keyframe(first.keyframe).frame;
  landmark.max_distance = (landmark.in_world - frame.world_from_camera.translation()).norm() *
                          model_.Scale(frame, first.keypoint);
}

std::size_t Map::working_set_bytes() const {
  constexpr std::size_t kLink = sizeof(void*);  // In a hash map: one per node, one per bucket.
  std::size_t num_bytes =
      kLink * (keyframes_.bucket_count() + landmarks_.bucket_count() + merged_into_.bucket_count());
  for (const auto& entry : keyframes_) {
    num_bytes += kLink + sizeof entry - sizeof(Frame) + NumBytes(entry.second.frame);
  }
  for (const auto& entry : landmarks_) {
    num_bytes += kLink + sizeof entry + entry.second.track.capacity() * sizeof(TrackElement);
  }
  return num_bytes + merges_.size() * (sizeof(Merge) + kLink + 2 * sizeof(LandmarkId));
}

std::vector<LandmarkId> Map::FindObserved(const std::vector<KeyframeId>& keyframes) const {
  LandmarkId first = num_landmark_ids();
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : keyframe(id).frame.landmarks) {
      if (landmark != kNoId) first = std::min(first, landmark);
    }
  }
  std::vector<char> is_seen(num_landmark_ids() - first, 0);
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : keyframe(id).frame.landmarks) {
      if (landmark != kNoId) is_seen[landmark - first] = 1;
    }
  }
  std::vector<LandmarkId> landmarks;
  for (LandmarkId id = first; id < num_landmark_ids(); ++id) {
    if (is_seen[id - first]) landmarks.push_back(id);
  }
  return landmarks;
}

std::vector<LandmarkId> Map::LandmarksOf(KeyframeId id) const {
  std::vector<LandmarkId> landmarks = keyframe(id).frame.landmarks;
  std::erase(landmarks, kNoId);
  return landmarks;
}

std::vector<Covisible> Map::FindCovisible(KeyframeId id, int min_shared) const {
  return CountShared(keyframe(id).frame.landmarks, id, min_shared);
}

std::vector<Covisible> Map::FindCovisible(const Frame& frame, int min_shared) const {
  return CountShared(frame.landmarks, kNoId, min_shared);
}

std::vector<Covisible> Map::CountShared(const std::vector<LandmarkId>& landmarks, KeyframeId except,
                                        int min_shared) const {
  std::vector<int> shared(num_keyframes(), 0);
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = FindLandmark(id);
    if (landmark == nullptr) continue;
    for (const TrackElement& o : landmark->track) ++shared[o.keyframe];
  }
  std::vector<Covisible> covisible;
  for (KeyframeId id = 0; id < num_keyframes(); ++id) {
    if (id != except && shared[id] >= std::max(1, min_shared))
      covisible.push_back({id, shared[id]});
  }
  std::sort(covisible.begin(), covisible.end(), [](const Covisible& a, const Covisible& b) {
    return a.num_shared != b.num_shared ? a.num_shared > b.num_shared : a.keyframe > b.keyframe;
  });
  return covisible;
}

std::vector<double> DepthsOfLandmarks(const Map& map, const Frame& frame) {
  const SE3 camera_from_world = frame.world_from_camera.Inverse();
  std::vector<double> depths;
  for (const LandmarkId id : frame.landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark != nullptr) depths.push_back((camera_from_world * landmark->in_world).z());
  }
  return depths;
}

}  // namespace corvo
