// SPDX-License-Identifier: MIT
#include "vo/tracking/unposed_outcome.h"

namespace corvo {

void ExplainUnposed(bool has_map, const TrackingResult& tracking,
                    const InitializationResult& initialization, FrameOutcome& outcome) {
  const bool is_blank = initialization.reason == Reason::kTooFewFeatures;
  constexpr double kMostOfTheImage = 0.5;
  outcome.state = has_map ? State::kLost : State::kInitializing;
  outcome.reason = has_map && !is_blank ? tracking.reason : initialization.reason;
  if (is_blank && outcome.masked_share > kMostOfTheImage) outcome.reason = Reason::kStaticOverlay;
  outcome.num_matches = has_map ? tracking.num_matches : initialization.num_matches;
  outcome.num_inliers = has_map ? tracking.num_inliers : initialization.num_inliers;
  outcome.parallax_deg = initialization.parallax_deg;
}

bool ChainRotation(int frame, const InitializationResult& initialization, bool is_first,
                   const Map& map, FrameHistory& history) {
  if (is_first && initialization.reason == Reason::kReferenceFrame) {
    history.SetRotation(frame, frame, SO3());
  }
  if (!initialization.reference_from_newest) return false;
  history.SetRotation(frame, initialization.reference, *initialization.reference_from_newest);
  return history.RotationOf(frame, map).has_value();
}

}  // namespace corvo
