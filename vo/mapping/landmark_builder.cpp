#include "vo/mapping/landmark_builder.h"

#include "vo/mapping/culling.h"
#include "vo/mapping/landmark_creation.h"
#include "vo/mapping/landmark_fusion.h"

namespace corvo {

void LandmarkBuilder::Start(Map& map, KeyframeId keyframe, const Camera& camera,
                            const KeypointNoise& noise, const KeyframeOptions& options) {
  for (const LandmarkId id : map.keyframe(keyframe).frame.landmarks) {
    if (id != kNoId) map.UpdateAppearance(id, noise.octave_scales);
  }
  CullLandmarks(map, options, on_trial_);
  const LandmarkId first_new = map.num_landmark_ids();
  CreateLandmarks(map, keyframe, camera, noise, options);
  for (LandmarkId id = first_new; id < map.num_landmark_ids(); ++id) on_trial_.push_back(id);
  keyframe_ = keyframe;
}

std::vector<LandmarkMerge> LandmarkBuilder::Finish(Map& map, const Camera& camera,
                                                   const KeypointNoise& noise,
                                                   const KeyframeOptions& options) {
  constexpr int kAlignedKeyframes = 30;  // Newest, in which landmarks are still aligned.
  if (is_done()) return {};
  const FusedLandmarks fused = FuseLandmarks(map, keyframe_, camera, noise, options);
  map.DropPatches(keyframe_ - kAlignedKeyframes);
  keyframe_ = kNoId;
  return fused.merges;
}

}  // namespace corvo
