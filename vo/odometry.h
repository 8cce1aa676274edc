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
#include "vo/map/pose_graph.h"

namespace corvo {

class CameraMotion;
class FrameHistory;
class ImageMotion;
class Initializer;
class Mapper;
class Relocalizer;
class SegmentJoiner;
class Tracker;
struct InitializationResult;
struct MapUpdate;
struct TrackingResult;

/// The memory held, counted from the contents of the containers.
struct MemoryUse {
  std::size_t working_set_bytes = 0;  ///< Frames with features, and landmarks. Bounded.
  std::size_t keyframe_bytes = 0;     ///< Permanent data of every keyframe. Grows.
  std::size_t frame_bytes = 0;        ///< Permanent data of every frame. Grows.
};

/// Monocular visual odometry, which returns one FrameResult for each image. It is deterministic:
/// the same images, camera and options yield the same results for any number of threads. Instances
/// share no data.
class Odometry {
 public:
  /// Processes each frame with `threads` threads and adjusts the map on up to two more, in parallel
  /// to the following frames. Throws corvo::Error if an option is out of range.
  explicit Odometry(const Camera& camera, const OdometryOptions& options = {}, int threads = 1);

  /// Like the above, but with a prior of the camera other than that of MakePrior(). Also throws
  /// corvo::Error if the prior is invalid.
  explicit Odometry(const CameraPrior& prior, const OdometryOptions& options = {}, int threads = 1);

  /// A moved-from object throws corvo::Error when it is used, until another one is assigned to it.
  Odometry(Odometry&&) noexcept;
  Odometry& operator=(Odometry&&) noexcept;
  ~Odometry();

  /// Processes one image. `image` is 8-bit gray and has the camera's size; `time_ns` is later than
  /// that of the previous frame; `mask` is empty or 8-bit and has the size of `image`; features are
  /// detected only where it is nonzero. Throws corvo::Error otherwise, without changing the state.
  FrameResult Process(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask = cv::Mat());

  /// Adds a frame whose image is missing, for the reason kUnreadableImage or kWrongSize. It gets no
  /// pose; tracking goes on with the next image, as after a longer time. `time_ns` is later than
  /// that of the previous frame. Throws corvo::Error otherwise, without changing the state.
  FrameResult ProcessMissing(TimeNs time_ns, Reason reason);

  /// Returns all frames so far with their current poses: later adjustments change earlier poses,
  /// frames before the initialization obtain poses afterwards, and a segment that sees landmarks of
  /// an earlier one becomes part of it.
  Trajectory GetTrajectory() const;

  /// Returns the keyframes so far with their current poses and the edges between them.
  PoseGraph GetPoseGraph() const;

  /// Ends the sequence: waits for the work in the background, estimates the camera once more from
  /// the newest keyframes and returns the trajectory, which does not change until the next call to
  /// Process.
  Trajectory Finish();

  /// Resets to the state after construction, with the same camera, options and callbacks.
  void Reset();

  /// Returns the keyframes and landmarks. Only the newest keyframes, and those that share landmarks
  /// with the very newest, have features and landmarks: others have been marginalized.
  const Map& map() const;

  /// Sets the callback that is called with each landmark that is marginalized. Such a landmark
  /// moves again only if its segment is joined with an earlier one: see ApplyJoins().
  void SetLandmarkCallback(LandmarkCallback callback);

  /// Sets the callback that is called with the observations of each frame. See
  /// vo/offline/refiner.h.
  void SetObservationCallback(ObservationCallback callback);

  MemoryUse memory_use() const;

  /// Returns the frame processed last, with its tracks: keypoint k observes landmark
  /// `landmarks[k]`, or none if that is kNoId. The frame is empty before the first image.
  const Frame& last_frame() const;

  /// Returns the 8-bit mask with which the last image was searched for features: the given mask,
  /// less what moves with the camera. It is empty if nothing was excluded.
  const cv::Mat& last_mask() const { return used_mask_; }

  /// Returns the current estimate of the camera, which is the given one at first.
  const Camera& camera() const;
  /// Returns the camera's difference from the given one, with its covariance.
  const CameraEstimate& camera_estimate() const;
  /// Returns the given prior; no parameter is free if `calibration.enabled` is false.
  const CameraPrior& camera_prior() const;
  /// Returns whether the images contradict the given camera beyond its sigmas; it is then used as
  /// given.
  bool prior_rejected() const;
  const OdometryOptions& options() const;

  /// Returns the stage times of the frame processed last.
  const StageTimes& last_times() const { return clock_.times(); }

 private:
  struct FirstImage {
    int index = 0;
    cv::Mat image, mask;
  };

  /// Throws corvo::Error if the object was moved from.
  void CheckNotMovedFrom() const;
  /// Locates the next frame and extends the map with it, or passes it to the initializer.
  FrameResult LocateFrame(Frame frame);
  /// Keeps a copy of an image that may have to be located again, if it is one of the first.
  void KeepFirstImage(const cv::Mat& image, const cv::Mat& mask);
  /// Removes what has been found to move with the camera from the map and from frames. Frames that
  /// wait for a map, or whose poses depended on it, are located again.
  void RemoveOverlay();
  /// Discards all poses and the map, and processes the first images again.
  void LocateFirstImages();
  /// Discards all poses and the map. Initialization begins anew.
  void Restart(Reason reason);
  Frame ExtractFrame(int index, const cv::Mat& image, const cv::Mat& mask);
  /// Updates everything that depends on keyframes and camera after an update of the map.
  void ApplyUpdate(const MapUpdate& update);
  /// Waits for all work on the map that has been started.
  void FinishMapping();
  /// Locates a frame in the map, if there is one: near the previous frame or, failing that,
  /// anywhere.
  TrackingResult Track(Frame& frame);
  void InsertKeyframe(TrackingResult& tracking, Frame& frame);
  /// Joins the segment of `frame`, which is the newest keyframe, with another one if the camera has
  /// come to see its landmarks.
  void JoinSegments(Frame& frame);
  /// Completes a tracked frame: its result, its place in the trajectory and the motion to expect
  /// next.
  FrameResult Accept(Frame frame, const TrackingResult& tracking);
  /// Passes a frame that could not be located to the initializer, whose map starts a segment.
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
  std::unique_ptr<ImageMotion> image_motion_;
  orb::Extractor extractor_;
  Map map_;
  std::unique_ptr<Initializer> initializer_;
  std::unique_ptr<Tracker> tracker_;
  std::unique_ptr<Relocalizer> relocalizer_;
  std::unique_ptr<SegmentJoiner> joiner_;
  std::unique_ptr<Mapper> mapper_;
  std::unique_ptr<CameraMotion> motion_;
  std::unique_ptr<FrameHistory> history_;
  ObservationRecorder recorder_;
  State state_ = State::kInitializing;
  int segment_ = kNoId;                   // kNoId until a pose or rotation is known.
  Frame previous_;                        // The last posed frame.
  std::vector<FirstImage> first_images_;  // See KeepFirstImage().
  cv::Mat used_mask_;
  StageClock clock_;
};

}  // namespace corvo
