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

/// Options for rendering a sequence. The scenes and the paths through them are fixed and do not
/// depend on the length or the size of a sequence.
struct SequenceOptions {
  int frames = 300;
  int width = 0;           ///< px; height and focal length scale with it. 0 for the scene's size.
  double noise_sigma = 0;  ///< Standard deviation of the Gaussian noise added to each pixel, gray.
  std::uint64_t noise_seed = 1;
  Effects effects;
  TimeSpan turn;  ///< The camera stops and rotates about its center by 40° to either side and back.
  std::optional<CameraParameters> camera;  ///< Overrides the scene's camera and `width`.

  /// Throws corvo::Error with the name of the first field that is out of range.
  void Validate() const;
};

/// The images and poses of one camera on a path through a scene.
class Sequence {
 public:
  /// `scene_from_camera` has one pose per frame. The last poses remain unused if the camera stops
  /// for a turn. Throws corvo::Error if the options are out of range.
  Sequence(std::string name, std::shared_ptr<const Scene> scene, const Camera& camera,
           double frame_rate_hz, const std::vector<SE3>& scene_from_camera,
           const SequenceOptions& options);

  int size() const { return static_cast<int>(poses_.size()); }
  const std::string& name() const { return name_; }
  const Camera& camera() const { return renderer_.camera(); }
  double frame_rate_hz() const { return frame_rate_hz_; }
  const SequenceOptions& options() const { return options_; }
  const Scene& scene() const { return *scene_; }

  /// Returns the exact ground truth, one pose per frame, starting at 0 ns. The world frame is that
  /// of the first camera.
  const PoseSequence& poses() const { return poses_; }
  SE3 scene_from_camera(int frame) const;

  /// Returns the time of a frame, or of a moment between two frames, s.
  double SecondsAt(double frame) const { return frame / frame_rate_hz_; }

  /// Returns the image, 8-bit gray. It does not depend on the order in which frames are rendered.
  cv::Mat Render(int frame) const;
  /// Returns the depth image, CV_32FC1: the z coordinate in the camera frame of the surface at each
  /// pixel's center, m; 0 if there is none.
  cv::Mat RenderDepth(int frame) const;

 private:
  /// Returns the pose at a moment by interpolation between frames. It is constant before the first
  /// and after the last frame.
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

/// Makes a hand-held walk around a furnished room of 6 x 5 x 3 m: a loop of about 9 m in 300 frames
/// of 640x480 at 30 Hz, with a changing viewing direction.
Sequence MakeRoom(const SequenceOptions& options = {});

/// Makes a drive along a street of houses with gentle bends and right angles, 0.5 to 0.8 m per
/// frame, 1241x376 at 10 Hz. The street is as long as the number of frames requires.
Sequence MakeStreet(const SequenceOptions& options = {});

/// Makes a sequence in which one plane fills the view: the camera moves back and forth in front of
/// a painted wall. 640x480 at 30 Hz.
Sequence MakePlanarWall(const SequenceOptions& options = {});

/// Makes a hand-held walk down a corridor with little texture: plain walls, doors, lamps, and a few
/// notices; 25 m back and forth, 640x480 at 30 Hz.
Sequence MakeCorridor(const SequenceOptions& options = {});

/// Makes a sequence of the room with pure rotation about the camera's center, 640x480 at 30 Hz.
Sequence MakePureRotation(const SequenceOptions& options = {});

}  // namespace corvo::synthetic
