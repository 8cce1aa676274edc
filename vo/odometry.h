#pragma once

#include <memory>

#include <opencv2/core/mat.hpp>

#include "vo/camera.h"
#include "vo/conventions.h"
#include "vo/frame_result.h"
#include "vo/map.h"
#include "vo/options.h"
#include "vo/trajectory.h"

namespace corvo {

/// Wall time of the stages of one frame, ms. Never part of a result that must reproduce.
struct StageTimes {
  double extract_ms = 0;
  double track_ms = 0;    ///< Initialisation or tracking.
  double map_ms = 0;      ///< Triangulation, fusion and culling after a keyframe.
  double adjust_ms = 0;   ///< Bundle adjustment.
};

/// Monocular visual odometry: images in, one FrameResult an image out. Deterministic: the same
/// images, camera and options give the same results, for any `threads`. Instances share nothing.
class Odometry {
 public:
  /// Throws corvo::Error on a camera or options out of range.
  explicit Odometry(const Camera& camera, const OdometryOptions& options = {}, int threads = 1);
  ~Odometry();
  Odometry(Odometry&&) noexcept;
  Odometry& operator=(Odometry&&) noexcept;

  /// `image` is 8-bit grey, of the camera's size; `time_ns` lies after the frame before. Throws
  /// corvo::Error otherwise, and is then as it was before the call.
  FrameResult Process(const cv::Mat& image, TimeNs time_ns);

  /// Every frame so far, with poses as the map knows them now: later adjustment moves earlier
  /// poses, and frames seen before initialisation get poses afterwards.
  Trajectory GetTrajectory() const;

  const Map& map() const;
  const StageTimes& last_times() const;
};

}  // namespace corvo
