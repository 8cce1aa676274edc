// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "apps/synthetic/boards.h"
#include "apps/synthetic/effects.h"
#include "apps/synthetic/renderer.h"
#include "apps/synthetic/scene.h"
#include "vo/camera/camera.h"
#include "vo/core/conventions.h"
#include "vo/core/trajectory.h"
#include "vo/lie/se3.h"

namespace corvo::synthetic {

/// How to film a scene. The scenes themselves and the paths through them are fixed: a shorter or
/// smaller sequence shows the same.
struct SequenceOptions {
  int frames = 300;
  int width = 0;           ///< px; the height and the focal length follow. 0: the scene's own size.
  double noise_sigma = 0;  ///< Standard deviation of the Gaussian noise added to each pixel, gray.
  std::uint64_t noise_seed = 1;
  Effects effects;
  TimeSpan
      turn;  ///< The camera stands, and turns about its own center 40° to either side and back.
  std::optional<CameraParameters> camera;  ///< Overrides the scene's camera and `width`.

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// What one camera films on its way through a scene.
class Sequence {
 public:
  /// `scene_from_camera`: one pose a frame; where the camera stands for a turn, the last ones stay
  /// unused. Throws corvo::Error on options out of range.
  Sequence(std::string name, std::shared_ptr<const Scene> scene, const Camera& camera,
           double frame_rate_hz, const std::vector<SE3>& scene_from_camera,
           const SequenceOptions& options);

  int size() const { return static_cast<int>(poses_.size()); }
  const std::string& name() const { return name_; }
  const Camera& camera() const { return renderer_.camera(); }
  double frame_rate_hz() const { return frame_rate_hz_; }
  const SequenceOptions& options() const { return options_; }
  const Scene& scene() const { return *scene_; }

  /// Exact truth, a pose a frame, from 0 ns on. The world is the first camera.
  const PoseSequence& poses() const { return poses_; }
  SE3 scene_from_camera(int frame) const;

  /// Time of a frame, or of a moment between two, s.
  double SecondsAt(double frame) const { return frame / frame_rate_hz_; }

  /// 8-bit gray. The same bytes whenever and in whatever order frames are rendered.
  cv::Mat Render(int frame) const;
  /// CV_32FC1: z in the camera of what each pixel's center shows, m; 0 for nothing.
  cv::Mat RenderDepth(int frame) const;

 private:
  /// Of a moment between two frames, in between; before the first and after the last, theirs.
  SE3 PoseAt(double frame) const;
  std::vector<Quad> MovingQuadsAt(double frame) const;
  cv::Mat RenderMoment(double frame) const;
  cv::Mat RenderBlurred(int frame) const;

  std::string name_;
  std::shared_ptr<const Scene> scene_;
  std::optional<Boards> boards_;
  Renderer renderer_;
  double frame_rate_hz_;
  SequenceOptions options_;
  SE3 scene_from_world_;
  PoseSequence poses_;
};

/// A walk round a furnished room of 6 x 5 x 3 m: a loop of about 9 m in 300 frames of 640x480 at
/// 30 Hz, hand-held, looking about.
Sequence MakeRoom(const SequenceOptions& options = {});

/// A drive along a street of houses with gentle bends and right angles, 0.5 to 0.8 m a frame,
/// 1241x376 at 10 Hz. As long as the frames ask for.
Sequence MakeStreet(const SequenceOptions& options = {});

/// One plane fills the view: the camera moves back and forth before a painted wall. 640x480 at 30
/// Hz.
Sequence MakePlanarWall(const SequenceOptions& options = {});

/// A walk down a corridor with little texture: plain walls, doors, lamps, and a notice here and
/// there; 25 m back and forth. 640x480 at 30 Hz, hand-held.
Sequence MakeCorridor(const SequenceOptions& options = {});

/// The room, from a camera that turns about its own center and does not move. 640x480 at 30 Hz.
Sequence MakePureRotation(const SequenceOptions& options = {});

}  // namespace corvo::synthetic
