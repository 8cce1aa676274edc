// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/map/observation.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// The posed frames between the newest keyframes. They are not part of the map, but what they
/// observe makes the adjustment of a window more accurate.
class IntermediateFrames {
 public:
  /// Keeps the frames that follow the newest `num_keyframes` keyframes, of which at most
  /// `per_keyframe` each take part in an adjustment.
  IntermediateFrames(int num_keyframes, int per_keyframe)
      : num_keyframes_(num_keyframes), per_keyframe_(per_keyframe) {}

  /// Adds a posed frame of a segment. Does nothing if it is the newest keyframe, or if that belongs
  /// to another segment.
  void Add(const Frame& frame, int segment, const Map& map);

  /// Returns the memory held, counted from the contents.
  std::size_t num_bytes() const;

  /// Forgets all frames, as after the keyframes have changed their unit of length.
  void Clear() { frames_.clear(); }

  /// Adds to a bundle of keyframes some of the frames that follow its free keyframes, evenly
  /// spaced, as free views without a keyframe, with what they observe of its points.
  void AddTo(const Map& map, Bundle& bundle) const;

  /// Removes what AddTo() has added.
  static void RemoveFrom(Bundle& bundle);

 private:
  struct PosedFrame {
    KeyframeId keyframe = kNoId;  ///< The one that the frame follows.
    SE3 keyframe_from_camera;
    std::vector<Observation> observations;
  };

  /// Returns frames that follow a keyframe, evenly spaced.
  std::vector<const PosedFrame*> Select(KeyframeId keyframe) const;

  int num_keyframes_;
  int per_keyframe_;
  std::deque<PosedFrame> frames_;  ///< In order of time.
};

}  // namespace corvo
