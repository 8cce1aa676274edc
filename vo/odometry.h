#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/extractor.h"
#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/core/trajectory.h"
#include "vo/map/frame.h"
#include "vo/map/frame_history.h"
#include "vo/map/frame_observations.h"
#include "vo/map/keypoint_noise.h"
#include "vo/map/map.h"
#include "vo/mapping/landmark_builder.h"
#include "vo/mapping/map_adjuster.h"
#include "vo/tracking/initializer.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// Wall time of the stages of one frame, ms. Never part of a result that must reproduce.
struct StageTimes {
  double extract_ms = 0;
  double locate_ms = 0;  ///< Initialisation or tracking.
  double map_ms = 0;     ///< Landmarks and keyframes made, fused and culled.
  double adjust_ms = 0;  ///< Bundle adjustment.
};

/// Bytes held, by counting what the containers hold.
struct MemoryUse {
  std::size_t working_set_bytes = 0;  ///< Frames with features, and landmarks. Bounded.
  std::size_t keyframe_bytes = 0;     ///< What stays of every keyframe. Grows.
  std::size_t frame_bytes = 0;        ///< What stays of every frame. Grows.
};

/// Monocular visual odometry: images in, one FrameResult an image out. Deterministic: the same
/// images, camera and options give the same results, for any number of threads. Instances share
/// nothing.
class Odometry {
 public:
  /// `threads` share the work of a frame; the map is adjusted by one more, beside the frames that
  /// follow. Throws corvo::Error on options out of range.
  explicit Odometry(const Camera& camera, const OdometryOptions& options = {}, int threads = 1);

  /// A camera known as `prior` says, where that is not what MakePrior assumes. Throws corvo::Error
  /// also on a prior that is not valid.
  explicit Odometry(const CameraPrior& prior, const OdometryOptions& options = {}, int threads = 1);

  /// `image` is 8-bit grey, of the camera's size; `time_ns` lies after the frame before; `mask`
  /// is empty or of the image's size, 8-bit: features are found where it is not 0. Throws
  /// corvo::Error otherwise, and is then as it was before the call.
  FrameResult Process(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask = cv::Mat());

  /// Every frame so far, with poses as the map knows them now: later adjustment moves earlier
  /// poses, and frames seen before initialisation get poses afterwards.
  Trajectory GetTrajectory() const { return records_.ToTrajectory(map_); }

  /// Ends the sequence: joins work done beside the frames, estimates the camera once more with the
  /// newest keyframes and returns the trajectory, which then stays as it is until the next call to
  /// Process.
  Trajectory Finish();

  /// As newly made, with the same camera and options.
  void Reset();

  /// Keyframes and landmarks. Features and landmarks are those of the newest keyframes, and of
  /// those that share landmarks with the very newest: others have left.
  const Map& map() const { return map_; }

  /// Calls `sink` with each landmark that leaves the map from now on, to go nowhere else. Stays
  /// through a Reset.
  using LandmarkSink = std::function<void(const FinishedLandmark&)>;
  void SetLandmarkSink(LandmarkSink sink) { landmark_sink_ = std::move(sink); }

  /// Calls `sink` with what each frame saw, from now on. Stays through a Reset. See
  /// vo/offline/refiner.h.
  void SetSightingsSink(SightingsSink sink) { sightings_sink_ = std::move(sink); }

  /// Calls `visit` with what every keyframe sees that is kept in the map.
  void VisitKeyframes(const SightingsSink& visit) const;

  MemoryUse memory_use() const;

  /// The frame processed last, with its tracks: keypoint k sees landmark `landmarks[k]` or, if
  /// that is kNoId, none. Before the first frame, it is empty.
  const Frame& last_frame() const;

  /// As it was given, or as it is estimated meanwhile.
  const Camera& camera() const { return adjuster_.camera(); }
  /// How far that is from what was given, and how surely.
  const CameraEstimate& camera_estimate() const { return adjuster_.camera_estimate(); }
  /// What was given; nothing is free where `calibration.enabled` is false.
  const CameraPrior& camera_prior() const { return adjuster_.camera_prior(); }
  /// The pictures do not fit the given camera within its sigmas: it is used as it was given.
  bool contradicts_given_camera() const { return adjuster_.contradicts_given_camera(); }
  const OdometryOptions& options() const { return options_; }

  const StageTimes& last_times() const { return times_; }

 private:
  void CheckInput(const cv::Mat& image, TimeNs time_ns) const;
  Frame ExtractFrame(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask);

  /// Locates the frame in the map, if there is one: near the frame before or, failing that,
  /// anywhere.
  TrackingResult Track(Frame& frame);
  bool NeedsKeyframe(const Frame& frame) const;
  /// Makes the frame a keyframe and begins to add landmarks around it.
  void ExtendMap(Frame& frame);
  /// What is left to do for the map, a frame's share: takes an adjustment that is due, adds
  /// landmarks, begins the next adjustment.
  void ContinueMapping(int frame);
  void FinishLandmarks();
  /// All of ContinueMapping but for the next adjustment, to its end.
  void FinishMapping();
  /// Takes the results of adjustments that are due before a frame, waiting for them.
  void TakeAdjustments(int frame);
  /// Keeps what the relocalizer looks at and what belongs to it; the rest leaves the map.
  void ArchiveKeyframes();
  /// Ends a tracked frame: its result, its place in the trajectory, the motion to expect next.
  FrameResult Accept(Frame frame, const TrackingResult& tracking);

  /// Gives a frame that could not be located to the initializer, whose map opens a segment.
  FrameResult Initialize(Frame frame, const TrackingResult& tracking);
  void SetUnposed(int frame, const TrackingResult& tracking,
                  const InitializationResult& initialization);
  /// The frame's rotation against the initializer's reference, if that has one.
  void SetRotation(int frame, const InitializationResult& initialization);
  bool MayStartSegment(TimeNs time_ns) const;
  /// Puts a first map into the world of the segments before: where, and as fast as, the camera is
  /// expected to be.
  void StartSegment(const InitializationResult& initialization);
  /// Where the first frame of a segment is expected.
  SE3 PredictStart(const Frame& first) const;
  void AddInitialMap(const InitialMap& initial, double scale, Frame& first, Frame& second);
  /// Locates the frames after (step 1) or before (step -1) a located one, up to the next that has
  /// a pose.
  void PlaceWaitingFrames(std::vector<Frame>& frames, int located, int step);

  bool has_map() const { return map_.num_keyframes() > 0; }
  /// Constant velocity.
  SE3 PredictPose(const Frame& from, TimeNs time_ns) const;
  double ChainScale(const InitialMap& initial, TimeNs baseline_ns) const;
  void SetMotion(const Frame& from, const Frame& to);
  void SetPosed(const Frame& frame, int num_matches, int num_inliers);
  void AddSighting(const Frame& frame, int keypoint, FrameSightings& sightings) const;
  /// Of a frame or, if it is one, of a keyframe.
  FrameSightings SightingsOf(const Frame& frame, int segment, KeyframeId keyframe) const;
  /// Gives the sink what a posed frame saw ...
  void TellPosed(const Frame& frame);
  /// ... or a keyframe that leaves the map, with the other last sightings of landmarks that leave
  /// with it.
  void TellLeaving(const Keyframe& keyframe) const;

  OdometryOptions options_;
  int threads_;
  orb::Extractor extractor_;
  KeypointNoise noise_;
  Initializer initializer_;
  Map map_;
  LandmarkSink landmark_sink_;
  SightingsSink sightings_sink_;
  std::vector<LandmarkMerge> untold_merges_;  // For the sink.
  LandmarkBuilder landmark_builder_;
  MapAdjuster adjuster_;
  FrameRecords records_;
  State state_ = State::kInitializing;
  int segment_ = kNoId;  // kNoId before anything is known of any frame.
  Frame previous_;       // The last posed frame.
  SE3 motion_;           // earlier_from_later over the last step between posed frames ...
  TimeNs step_ns_ = 0;   // ... and how long it took; 0 before the first.
  StageTimes times_;
};

}  // namespace corvo
