// SPDX-License-Identifier: MIT
#include "apps/output/track_history.h"

namespace corvo {

cv::Point2f PixelOf(const Frame& frame, int keypoint) {
  const orb::Keypoint& point = frame.keypoint(keypoint);
  return {point.x, point.y};
}

void TrackHistory::Add(const Frame& frame) {
  for (int i = 0; i < frame.num_keypoints(); ++i) {
    if (frame.landmarks[i] == kNoId) continue;
    Track& track = tracks_[frame.landmarks[i]];
    ++track.age;
    track.last_frame = frame.index;
    track.pixels.push_back(PixelOf(frame, i));
    if (track.pixels.size() > Track::kMaxPixels) track.pixels.erase(track.pixels.begin());
  }
  std::erase_if(tracks_, [&](const auto& entry) {
    return frame.index - entry.second.last_frame > static_cast<int>(Track::kMaxPixels);
  });
}

}  // namespace corvo
