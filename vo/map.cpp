#include "vo/map.h"

#include <algorithm>
#include <utility>

#include "orb/hamming.h"

namespace corvo {
namespace {

std::vector<Observation>::const_iterator FindObservation(const Landmark& landmark,
                                                         KeyframeId keyframe) {
  return std::find_if(landmark.observations.begin(), landmark.observations.end(),
                      [&](const Observation& o) { return o.keyframe == keyframe; });
}

/// The descriptor with the least median distance to all others (the first of equals).
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

const Landmark* Map::FindLandmark(LandmarkId id) const {
  if (id < 0 || id >= num_landmark_ids() || !landmarks_[id]) return nullptr;
  return &*landmarks_[id];
}

LandmarkId Map::Resolve(LandmarkId id) const {
  while (id != kNoId && !landmarks_[id]) id = merged_into_[id];
  return id;
}

SE3 Map::WorldFromKeyframe(KeyframeId id) const {
  SE3 current_from_keyframe;
  while (keyframes_[id].retired()) {
    current_from_keyframe = keyframes_[id].anchor_from_keyframe * current_from_keyframe;
    id = keyframes_[id].anchor;
  }
  return keyframes_[id].frame.world_from_camera * current_from_keyframe;
}

KeyframeId Map::AddKeyframe(Frame frame, int segment) {
  const KeyframeId id = num_keyframes();
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] == kNoId) continue;
    landmarks_[frame.landmarks[k]]->observations.push_back({id, k});
  }
  Keyframe keyframe;
  keyframe.id = id;
  keyframe.segment = segment;
  keyframe.frame = std::move(frame);
  keyframes_.push_back(std::move(keyframe));
  return id;
}

void Map::RetireKeyframe(KeyframeId id, KeyframeId anchor) {
  const std::vector<LandmarkId> landmarks = keyframes_[id].frame.landmarks;
  for (const LandmarkId landmark : landmarks) {
    if (landmark != kNoId && landmarks_[landmark]) RemoveObservation(landmark, id);
  }
  Keyframe& keyframe = keyframes_[id];
  keyframe.anchor = anchor;
  keyframe.anchor_from_keyframe =
      WorldFromKeyframe(anchor).Inverse() * keyframe.frame.world_from_camera;
  keyframe.frame.features = {};
  keyframe.frame.keypoint_index = {};
  keyframe.frame.rays = {};
  keyframe.frame.pixels = {};
  keyframe.frame.is_aligned = {};
  keyframe.frame.patches = {};
  keyframe.frame.landmarks = {};
}

void Map::UpdateRays(const Camera& camera) {
  for (Keyframe& keyframe : keyframes_) {
    if (!keyframe.retired()) corvo::UpdateRays(camera, keyframe.frame);
  }
}

void Map::SetPose(KeyframeId id, const SE3& world_from_camera) {
  keyframes_[id].frame.world_from_camera = world_from_camera;
}

/// By definition the keypoint lies where its own patch puts it.
Reference Map::MakeReference(const Observation& observation) {
  Frame& frame = keyframes_[observation.keyframe].frame;
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
                            std::vector<Observation> observations) {
  const LandmarkId id = num_landmark_ids();
  Landmark landmark;
  landmark.id = id;
  landmark.segment = keyframes_[observations.front().keyframe].segment;
  landmark.in_world = in_world;
  landmark.newest_keyframe = num_keyframes() - 1;
  landmark.num_visible = landmark.num_found = static_cast<int>(observations.size());
  const Observation& first = observations.front();
  landmark.reference = MakeReference(first);
  landmarks_.push_back(std::move(landmark));
  merged_into_.push_back(kNoId);
  for (const Observation& observation : observations) AddObservation(id, observation);
  return id;
}

void Map::SetPixel(const Observation& observation, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& ray) {
  Frame& frame = keyframes_[observation.keyframe].frame;
  frame.pixels[observation.keypoint] = pixel;
  frame.rays[observation.keypoint] = ray;
  frame.is_aligned[observation.keypoint] = 1;
}

void Map::SetPosition(LandmarkId id, const Eigen::Vector3d& in_world) {
  landmarks_[id]->in_world = in_world;
}

void Map::RemoveLandmark(LandmarkId id) {
  for (const Observation& o : landmarks_[id]->observations) {
    keyframes_[o.keyframe].frame.landmarks[o.keypoint] = kNoId;
  }
  landmarks_[id].reset();
}

void Map::MergeLandmark(LandmarkId from, LandmarkId into) {
  const Landmark old = *landmarks_[from];
  RemoveLandmark(from);
  merged_into_[from] = into;
  Landmark& merged = *landmarks_[into];
  merged.num_visible += old.num_visible;
  merged.num_found += old.num_found;
  for (const Observation& o : old.observations) {
    if (FindObservation(merged, o.keyframe) == merged.observations.end()) AddObservation(into, o);
  }
}

void Map::AddObservation(LandmarkId id, const Observation& observation) {
  std::vector<Observation>& observations = landmarks_[id]->observations;
  const auto later = std::find_if(observations.begin(), observations.end(),
                                  [&](const auto& o) { return o.keyframe > observation.keyframe; });
  observations.insert(later, observation);
  keyframes_[observation.keyframe].frame.landmarks[observation.keypoint] = id;
}

void Map::RemoveObservation(LandmarkId id, KeyframeId keyframe) {
  Landmark& landmark = *landmarks_[id];
  const auto found = FindObservation(landmark, keyframe);
  if (found == landmark.observations.end()) return;
  keyframes_[keyframe].frame.landmarks[found->keypoint] = kNoId;
  landmark.observations.erase(found);
  if (landmark.observations.size() < 2) RemoveLandmark(id);
}

void Map::UpdateAppearance(LandmarkId id, const std::vector<double>& octave_scales) {
  Landmark& landmark = *landmarks_[id];
  std::vector<orb::Descriptor> descriptors;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Observation& o : landmark.observations) {
    const Frame& frame = keyframes_[o.keyframe].frame;
    descriptors.push_back(frame.descriptor(o.keypoint));
    sum += (landmark.in_world - frame.world_from_camera.translation()).normalized();
  }
  landmark.descriptor = descriptors[FindMedoid(descriptors)];
  landmark.view_direction = sum.normalized();
  const Observation& first = landmark.observations.front();
  const Frame& frame = keyframes_[first.keyframe].frame;
  landmark.max_distance = (landmark.in_world - frame.world_from_camera.translation()).norm() *
                          octave_scales[frame.keypoint(first.keypoint).octave];
}

std::vector<LandmarkId> Map::FindSeen(const std::vector<KeyframeId>& keyframes) const {
  LandmarkId first = num_landmark_ids();
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : keyframes_[id].frame.landmarks) {
      if (landmark != kNoId) first = std::min(first, landmark);
    }
  }
  std::vector<char> is_seen(num_landmark_ids() - first, 0);
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : keyframes_[id].frame.landmarks) {
      if (landmark != kNoId) is_seen[landmark - first] = 1;
    }
  }
  std::vector<LandmarkId> landmarks;
  for (LandmarkId id = first; id < num_landmark_ids(); ++id) {
    if (is_seen[id - first]) landmarks.push_back(id);
  }
  return landmarks;
}

std::vector<Covisible> Map::FindCovisible(KeyframeId id, int min_shared) const {
  return CountShared(keyframes_[id].frame.landmarks, id, min_shared);
}

std::vector<Covisible> Map::FindCovisible(const Frame& frame, int min_shared) const {
  return CountShared(frame.landmarks, kNoId, min_shared);
}

std::vector<Covisible> Map::CountShared(const std::vector<LandmarkId>& landmarks, KeyframeId except,
                                        int min_shared) const {
  std::vector<int> shared(keyframes_.size(), 0);
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = FindLandmark(id);
    if (landmark == nullptr) continue;
    for (const Observation& o : landmark->observations) ++shared[o.keyframe];
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

}  // namespace corvo
