#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/map/keypoint_noise.h"
#include "vo/map/map.h"

namespace corvo {

/// Makes the landmarks around a new keyframe in two parts, so that no frame waits for both. Every
/// landmark is on trial for its first keyframes.
class LandmarkBuilder {
 public:
  /// Culls the landmarks that failed their trial and creates those that a keyframe sees. What was
  /// started before must be done.
  void Start(Map& map, KeyframeId keyframe, const Camera& camera, const KeypointNoise& noise,
             const KeyframeOptions& options);

  bool is_done() const { return keyframe_ == kNoId; }

  /// Joins what is known twice around the keyframe, and returns which landmarks were merged. No
  /// effect where it is done.
  std::vector<LandmarkMerge> Finish(Map& map, const Camera& camera, const KeypointNoise& noise,
                                    const KeyframeOptions& options);

  /// A landmark that was made elsewhere.
  void AddOnTrial(LandmarkId id) { on_trial_.push_back(id); }

 private:
  KeyframeId keyframe_ = kNoId;  // Whose landmarks are to be joined.
  std::vector<LandmarkId> on_trial_;
};

}  // namespace corvo
