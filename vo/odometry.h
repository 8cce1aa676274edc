// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/extractor.h"
#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/core/stage_times.h"
#include "vo/core/trajectory.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/map/observation_recorder.h"
#include "vo/tracking/motion_model.h"

namespace corvo {

class FrameHistory;
class Initializer;
class Mapper;
class Relocalizer;
class Tracker;
struct InitializationResult;
struct MapUpdate;
struct TrackingResult;

/// Bytes held, by counting what the containers hold.
struct MemoryUse {
  std::size_t working_set_bytes = 0;  ///< Frames with features, and landmarks. Bounded.
  std::size_t keyframe_bytes = 0;     ///< What stays of every keyframe. Grows.
  std::size_t frame_bytes = 0;        ///< What stays of every frame. Grows.
};

/// Monocular visual odometry: images in, one FrameResult for each image out. Deterministic: the
/// same images, camera and options give the same results, for any number of threads. Instances
/// share nothing.
class Odometry {
 public:
  /// `threads` share the work of a frame; the map is adjusted by one more, beside the frames that
  /// follow. Throws corvo::Error on options out of range.
  explicit Odometry(const Camera& camera, const OdometryOptions& options = {}, int threads = 1);

  /// A camera known as `prior` says, where that is not what MakePrior assumes. Throws corvo::Error
  /// also on a prior that is not valid.
  explicit Odometry(const CameraPrior& prior, const OdometryOptions& options = {}, int threads = 1);

  Odometry(Odometry&&) noexcept;
  Odometry& operator=(Odometry&&) noexcept;
  ~Odometry();

  /// `image` is 8-bit gray, of the camera's size; `time_ns` is later than that of the previous
  /// frame; `mask` is empty or 8-bit and of the image's size: features are found where it is not 0.
  /// Throws corvo::Error otherwise, and is then as it was before the call.
  FrameResult Process(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask = cv::Mat());

  /// Every frame so far, with poses as the map knows them now: later adjustments move earlier
  /// poses, and frames seen before initialization get poses afterwards.
  Trajectory GetTrajectory() const;

  /// Ends the sequence: waits for the work done beside the frames, estimates the camera once more
  /// with the newest keyframes and returns the trajectory, which then stays as it is until the next
  /// call to Process.
  Trajectory Finish();

  /// As newly constructed, with the same camera, options and callbacks.
  void Reset();

  /// Keyframes and landmarks. Features and landmarks are those of the newest keyframes, and of
  /// those that share landmarks with the very newest: others have been marginalized.
  const Map& map() const { return map_; }

  /// Calls `callback` with each landmark that leaves the map from now on, to go nowhere else.
  void SetLandmarkCallback(LandmarkCallback callback) {
    recorder_.SetLandmarkCallback(std::move(callback));
  }

  /// Calls `callback` with what each frame observed, from now on. See vo/offline/refiner.h.
  void SetObservationCallback(ObservationCallback callback) {
    recorder_.SetObservationCallback(std::move(callback));
  }

  MemoryUse memory_use() const;

  /// The frame processed last, with its tracks: keypoint k observes landmark `landmarks[k]` or, if
  /// that is kNoId, none. Before the first frame, it is empty.
  const Frame& last_frame() const;

  /// The camera as it was given, or as it is estimated meanwhile.
  const Camera& camera() const { return map_.camera(); }
  /// How far that is from what was given, and how certain it is.
  const CameraEstimate& camera_estimate() const;
  /// What was given; nothing is free where `calibration.enabled` is false.
  const CameraPrior& camera_prior() const;
  /// The images do not fit the given camera within its sigmas: it is used as it was given.
  bool prior_rejected() const;
  const OdometryOptions& options() const { return options_; }

  /// Of the frame processed last.
  const StageTimes& last_times() const { return clock_.times(); }

 private:
  Frame ExtractFrame(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask);
  /// Brings what depends on keyframes and camera up to date with an update of the map.
  void ApplyUpdate(const MapUpdate& update);
  /// Waits for all work on the map that has been started.
  void FinishMapping();
  /// Locates a frame in the map, if there is one: near the previous frame or, failing that,
  /// anywhere.
  TrackingResult Track(Frame& frame);
  void InsertKeyframe(Frame& frame);
  /// Ends a tracked frame: its result, its place in the trajectory, the motion to expect next.
  FrameResult Accept(Frame frame, const TrackingResult& tracking);
  /// Gives a frame that could not be located to the initializer, whose map starts a segment.
  FrameResult Initialize(Frame frame, const TrackingResult& tracking);
  void StartSegment(const InitializationResult& initialization);
  /// Locates the frames after (step 1) or before (step -1) a located one, up to the next that has a
  /// pose.
  void LocalizePendingFrames(std::vector<Frame>& frames, int located, int step);
  void RecordPosed(const Frame& frame, int num_matches, int num_inliers);
  void RecordUnposed(int frame, const TrackingResult& tracking,
                     const InitializationResult& initialization);

  OdometryOptions options_;
  int threads_;
  orb::Extractor extractor_;
  Map map_;
  std::unique_ptr<Initializer> initializer_;
  std::unique_ptr<Tracker> tracker_;
  std::unique_ptr<Relocalizer> relocalizer_;
  std::unique_ptr<Mapper> mapper_;
  MotionModel motion_;
  std::unique_ptr<FrameHistory> history_;
  ObservationRecorder recorder_;
  State state_ = State::kInitializing;
  int segment_ = kNoId;  // kNoId before anything is known of any frame.
  Frame previous_;       // The last posed frame.
  StageClock clock_;
};

}  // namespace corvo
