// SPDX-License-Identifier: MIT
#include "bench/calibration/sequences.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "apps/synthetic/sequence.h"
#include "orb/error.h"
#include "tests/support/random.h"

namespace corvo::bench {
namespace {

constexpr int kPeriod = 600;  ///< At least the number of frames after which scenes repeat.

/// The first frame and the number of frames of a part of a sequence.
struct Stretch {
  int first = 0;
  int size = 0;
};

/// Returns the long stretches whose optical axes are almost parallel to that of their first frame.
std::vector<Stretch> FindStraights(const PoseSequence& poses) {
  constexpr double kMaxTurn = 0.01;  // rad
  constexpr int kMinSize = 70;
  std::vector<Stretch> straights;
  const int num_poses = static_cast<int>(poses.size());
  const auto axis = [&](int i) -> Eigen::Vector3d {
    return poses[i].world_from_camera.rotation().matrix().col(2);
  };
  for (int first = 0; first < num_poses;) {
    int end = first + 1;
    while (end < num_poses && axis(first).cross(axis(end)).norm() < kMaxTurn) ++end;
    const bool is_long = end - first >= kMinSize;
    if (is_long) straights.push_back({first, end - first});
    first = is_long ? end : first + 1;
  }
  if (straights.empty()) throw Error("the street has no straight");
  return straights;
}

synthetic::Sequence MakeScene(RenderScene scene, const synthetic::SequenceOptions& options) {
  if (scene == RenderScene::kRoom) return synthetic::MakeRoom(options);
  if (scene == RenderScene::kRotation) return synthetic::MakePureRotation(options);
  return synthetic::MakeStreet(options);
}

Stretch ChooseStretch(const ScenePart& part, const PoseSequence& poses) {
  if (part.scene == RenderScene::kStraight) {
    const std::vector<Stretch> straights = FindStraights(poses);
    return straights[static_cast<std::size_t>(part.seed) % straights.size()];
  }
  test::Random random(static_cast<std::uint64_t>(part.seed));
  return {random.UniformInt(0, kPeriod), part.frames};
}

}  // namespace

std::string ToString(RenderScene scene) {
  switch (scene) {
    case RenderScene::kStreet:
      return "street";
    case RenderScene::kRoom:
      return "room";
    case RenderScene::kStraight:
      return "street, straight on";
    case RenderScene::kRotation:
      return "pure rotation";
  }
  return "";
}

Recording Render(const ScenePart& part) {
  synthetic::SequenceOptions options;
  options.frames = kPeriod + part.frames;
  options.width =
      part.scene == RenderScene::kRoom || part.scene == RenderScene::kRotation ? 640 : 930;
  options.noise_sigma = 3;
  options.noise_seed = 1 + static_cast<std::uint64_t>(part.seed);
  const Recording whole = RenderRecording(MakeScene(part.scene, options));
  const Stretch stretch = ChooseStretch(part, whole.truth);
  Recording film{whole.camera, {}, {}, {}};
  std::vector<cv::Mat> images;
  for (int i = stretch.first; i < stretch.first + stretch.size; ++i) {
    film.times.push_back(whole.times[i]);
    film.truth.push_back(whole.truth[i]);
    images.push_back(whole.image(i));
  }
  film.image = [images = std::move(images)](int i) { return images[i]; };
  return film;
}

}  // namespace corvo::bench
