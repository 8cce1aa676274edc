// SPDX-License-Identifier: MIT
#include "vo/odometry.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/map/frame_history.h"
#include "vo/mapping/contested_keypoints.h"
#include "vo/mapping/culling.h"
#include "vo/mapping/keyframe_policy.h"
#include "vo/mapping/mapper.h"
#include "vo/tracking/camera_motion.h"
#include "vo/tracking/image_motion.h"
#include "vo/tracking/initializer.h"
#include "vo/tracking/pending_frames.h"
#include "vo/tracking/relocalizer.h"
#include "vo/tracking/segment_joining.h"
#include "vo/tracking/segment_start.h"
#include "vo/tracking/tracker.h"
#include "vo/tracking/unposed_outcome.h"

namespace corvo {

Odometry::Odometry(const Camera& camera, const OdometryOptions& options, int threads)
    : Odometry(MakePrior(camera.parameters(), options.calibration), options, threads) {}

Odometry::Odometry(const CameraPrior& prior, const OdometryOptions& options, int threads)
    : options_(options.Checked()),
      threads_(threads),
      image_motion_(std::make_unique<ImageMotion>()),
      extractor_(orb::AdaptToImage(options.extractor, prior.given.width, prior.given.height),
                 threads),
      map_({Camera(prior.given), options.measurement, extractor_.octave_scales()}),
      initializer_(std::make_unique<Initializer>(options, map_.model())),
      tracker_(std::make_unique<Tracker>(options)),
      relocalizer_(std::make_unique<Relocalizer>(options)),
      joiner_(std::make_unique<SegmentJoiner>(options)),
      mapper_(std::make_unique<Mapper>(prior, options)),
      motion_(std::make_unique<CameraMotion>(options.segment_start)),
      history_(std::make_unique<FrameHistory>()) {}

Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;
Odometry::~Odometry() = default;

void Odometry::CheckNotMovedFrom() const {
  if (history_) return;
  throw Error("this Odometry was moved from; assign another one to it before it is used");
}

FrameResult Odometry::Process(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask) {
  CheckNotMovedFrom();
  // Invalid input leaves the state unchanged.
  CheckImage(image, camera());
  orb::CheckInput(image, mask);
  history_->CheckNext(time_ns);
  clock_.Reset();
  // An image that repeats the previous one says nothing about the motion: it gets the same pose.
  const ImageMotion::Result motion = image_motion_->Add(image);
  if (motion.is_repeat) return history_->ResultOf(history_->AddRepeat(time_ns), map_);
  // Texture that moves with the camera would hold the pose in place: it is masked.
  used_mask_ = image_motion_->overlay().Exclude(mask, image.size());
  if (motion.has_overlay_grown) RemoveOverlay();
  KeepFirstImage(image, mask);
  return LocateFrame(ExtractFrame(history_->Add(time_ns), image, used_mask_));
}

FrameResult Odometry::LocateFrame(Frame frame) {
  // The results of earlier adjustments are applied here, at a fixed frame, not when they are ready.
  ApplyUpdate(mapper_->Update(frame.index, map_, recorder_, clock_));
  TrackingResult tracking = Track(frame);
  // Before there is a map, and while tracking is lost, the frame may start a new segment.
  if (!tracking.is_tracked()) return Initialize(std::move(frame), tracking);
  // A moving camera leaves its landmarks behind; a keyframe creates new ones, or sees those of
  // another segment.
  if (NeedsKeyframe(CollectEvidence(map_, frame), options_.keyframes)) {
    InsertKeyframe(tracking, frame);
    JoinSegments(frame);
  }
  return Accept(std::move(frame), tracking);
}

FrameResult Odometry::ProcessMissing(TimeNs time_ns, Reason reason) {
  CheckNotMovedFrom();
  if (!IsMissingImage(reason)) {
    throw Error(fmt::format("reason of a missing image is {}; allowed is {} or {}",
                            ToString(reason), ToString(Reason::kUnreadableImage),
                            ToString(Reason::kWrongSize)));
  }
  history_->CheckNext(time_ns);
  clock_.Reset();
  const int frame = history_->AddMissing(time_ns, reason);
  history_->outcome(frame).state = map_.empty() ? State::kInitializing : State::kLost;
  history_->outcome(frame).segment = segment_;
  return history_->ResultOf(frame, map_);
}

Trajectory Odometry::Finish() {
  CheckNotMovedFrom();
  FinishMapping();
  if (map_.empty()) return GetTrajectory();
  mapper_->StartLastCalibration(history_->size(), map_);
  FinishMapping();
  mapper_->StartAdjustment(history_->size(), map_);
  FinishMapping();
  return GetTrajectory();
}

void Odometry::Reset() {
  ObservationRecorder recorder = recorder_.WithSameCallbacks();
  *this = Odometry(camera_prior(), options_, threads_);
  recorder_ = std::move(recorder);
}

Trajectory Odometry::GetTrajectory() const {
  CheckNotMovedFrom();
  return history_->ToTrajectory(map_);
}

PoseGraph Odometry::GetPoseGraph() const {
  CheckNotMovedFrom();
  return mapper_->GetPoseGraph(map_);
}

const Map& Odometry::map() const {
  CheckNotMovedFrom();
  return map_;
}

void Odometry::SetLandmarkCallback(LandmarkCallback callback) {
  CheckNotMovedFrom();
  recorder_.SetLandmarkCallback(std::move(callback));
}

void Odometry::SetObservationCallback(ObservationCallback callback) {
  CheckNotMovedFrom();
  recorder_.SetObservationCallback(std::move(callback));
}

const Camera& Odometry::camera() const {
  CheckNotMovedFrom();
  return map_.camera();
}

const OdometryOptions& Odometry::options() const {
  CheckNotMovedFrom();
  return options_;
}

const CameraEstimate& Odometry::camera_estimate() const {
  CheckNotMovedFrom();
  return mapper_->camera_estimate();
}

const CameraPrior& Odometry::camera_prior() const {
  CheckNotMovedFrom();
  return mapper_->camera_prior();
}

bool Odometry::prior_rejected() const {
  CheckNotMovedFrom();
  return mapper_->prior_rejected();
}

MemoryUse Odometry::memory_use() const {
  CheckNotMovedFrom();
  std::size_t working_set_bytes = map_.working_set_bytes() + initializer_->num_bytes() +
                                  NumBytes(previous_) + mapper_->num_frame_bytes();
  for (const FirstImage& first : first_images_) {
    working_set_bytes += first.image.total() + first.mask.total();
  }
  return {working_set_bytes, map_.keyframe_bytes() + mapper_->num_edge_bytes(),
          history_->num_bytes()};
}

const Frame& Odometry::last_frame() const {
  CheckNotMovedFrom();
  const Frame* pending = initializer_->newest();
  return pending != nullptr ? *pending : previous_;
}

void Odometry::KeepFirstImage(const cv::Mat& image, const cv::Mat& mask) {
  // An overlay is found once the scene has moved in some images. All limits bound memory; once one
  // is exceeded, it stays so.
  constexpr int kMaxFrames = 50, kMaxMovedImages = 30;
  constexpr std::size_t kMaxBytes = 128 << 20;
  const bool may_be_found = image_motion_->overlay().num_moved_images() <= kMaxMovedImages;
  const bool has_room = (history_->size() + 1) * image.total() <= kMaxBytes;
  if (history_->size() < kMaxFrames && may_be_found && has_room) {
    first_images_.push_back({history_->size(), image.clone(), mask.clone()});
  } else {
    first_images_ = {};
  }
}

void Odometry::RemoveOverlay() {
  // Until now, the first poses followed the motion of the overlay as well as that of the scene, and
  // frames waited for a map because it did not move.
  if (!first_images_.empty()) return LocateFirstImages();
  CullMaskedLandmarks(used_mask_, map_);
  RemoveMaskedKeypoints(used_mask_, previous_);
  initializer_->RemoveMasked(used_mask_);
  if (!map_.empty()) return;
  for (Frame& waiting : initializer_->TakeFrames()) LocateFrame(std::move(waiting));
}

void Odometry::LocateFirstImages() {
  Restart(Reason::kStaticOverlay);
  for (const FirstImage& first : first_images_) {
    const cv::Mat mask = image_motion_->overlay().Exclude(first.mask, first.image.size());
    LocateFrame(ExtractFrame(first.index, first.image, mask));
  }
}

void Odometry::Restart(Reason reason) {
  FinishMapping();
  history_->DiscardPoses(reason);
  Odometry restarted(camera_prior(), options_, threads_);
  restarted.map_ = Map(restarted.map_.model(), map_.num_landmark_ids());
  restarted.history_ = std::move(history_);
  restarted.image_motion_ = std::move(image_motion_);
  restarted.recorder_ = recorder_.WithSameCallbacks();
  restarted.used_mask_ = used_mask_;
  restarted.first_images_ = std::move(first_images_);
  *this = std::move(restarted);
}

Frame Odometry::ExtractFrame(int index, const cv::Mat& image, const cv::Mat& mask) {
  const StageClock::Scope scope(clock_, &StageTimes::extract_ms);
  orb::Features features;
  std::vector<orb::Patch> patches;
  extractor_.Extract(image, mask, features, patches);
  FrameOutcome& outcome = history_->outcome(index);
  Frame frame =
      MakeFrame(index, outcome.time_ns, std::move(features), camera(), std::move(patches));
  history_->SetFeatures(frame);
  outcome.masked_share = image_motion_->overlay().masked_share();
  return frame;
}

void Odometry::ApplyUpdate(const MapUpdate& update) {
  if (!update.adjustments.any()) return;
  history_->AddAdjustments(update.adjustments);
  initializer_->SetCamera(camera());
  UpdateRays(camera(), previous_);
  for (const KeyframeId culled : update.culled) history_->RemoveKeyframe(culled, map_);
  if (history_->IsPosed(previous_.index)) {
    previous_.world_from_camera = history_->PoseOf(previous_.index, map_);
  }
}

void Odometry::FinishMapping() { ApplyUpdate(mapper_->Finish(map_, recorder_, clock_)); }

TrackingResult Odometry::Track(Frame& frame) {
  const StageClock::Scope scope(clock_, &StageTimes::locate_ms);
  TrackingResult tracking;
  tracking.reason = Reason::kReferenceFrame;
  if (map_.empty()) return tracking;
  tracking = tracker_->Track(map_, previous_,
                             motion_->model().PredictAlternatives(previous_, frame.time_ns), frame);
  const bool is_sure =
      state_ == State::kTracking || tracking.num_inliers >= options_.relocalizer.min_inliers;
  if (tracking.is_tracked() && is_sure) return tracking;
  tracking = relocalizer_->Relocalize(segment_, map_, frame);
  // Where the frame shows the place of another segment, tracking continues there.
  if (tracking.is_tracked()) segment_ = SegmentOf(map_, frame);
  return tracking;
}

void Odometry::InsertKeyframe(TrackingResult& tracking, Frame& frame) {
  const StageClock::Scope scope(clock_, &StageTimes::map_ms);
  tracking.contested_share = RemoveContestedKeypoints(tracking.contradictions, frame);
  const KeyframeId keyframe = mapper_->InsertKeyframe(frame, segment_, map_);
  history_->AddKeyframe(frame.index, keyframe, map_);
}

void Odometry::JoinSegments(Frame& frame) {
  const StageClock::Scope scope(clock_, &StageTimes::map_ms);
  if (!joiner_->Search(map_)) return;
  FinishMapping();
  if (const std::optional<SegmentJoin> join = joiner_->Estimate(map_)) {
    history_->JoinSegments(*join, map_);
    recorder_.AddMerges(joiner_->MergeLandmarks(map_));
    mapper_->AdaptToJoin(*join, map_);
    if (segment_ == join->later) motion_->Transform(join->earlier_from_later);
    segment_ = join->earlier;
  }
  frame = map_.keyframe(map_.num_keyframes() - 1).frame;
  UpdateRays(camera(), frame);
}

FrameResult Odometry::Accept(Frame frame, const TrackingResult& tracking) {
  map_.CountSeen(tracking.visible, frame);
  mapper_->AddFrame(frame, segment_, map_);
  RecordPosed(frame, tracking.num_matches, tracking.num_inliers);
  history_->outcome(frame.index).health.found_share = tracking.found_share();
  previous_.world_from_camera = history_->PoseOf(previous_.index, map_);
  if (history_->outcome(previous_.index).segment == segment_) {
    const bool is_uncertain = motion_->IsScaleUncertain(map_, previous_, frame, tracking);
    if (is_uncertain) history_->outcome(frame.index).reason = Reason::kScaleUncertain;
    motion_->Add(previous_, frame);
  } else {
    motion_->EnterSegment();
  }
  std::vector<Frame> frames = initializer_->TakeFrames();
  frames.push_back(std::move(frame));
  LocalizePendingFrames(frames, static_cast<int>(frames.size()) - 1, -1);
  previous_ = std::move(frames.back());
  state_ = State::kTracking;
  return history_->ResultOf(previous_.index, map_);
}

FrameResult Odometry::Initialize(Frame frame, const TrackingResult& tracking) {
  const StageClock::Scope scope(clock_, &StageTimes::locate_ms);
  const int index = frame.index;
  const double lost_s = ToSeconds(frame.time_ns - previous_.time_ns);
  if (!map_.empty() && initializer_->newest() == nullptr) initializer_->StartFrom(previous_);
  const InitializationResult initialization = initializer_->AddFrame(std::move(frame));
  RecordUnposed(index, tracking, initialization);
  const bool may_start = map_.empty() || lost_s >= options_.relocalizer.max_lost_s;
  if (initialization.map && may_start) {
    FinishMapping();
    StartSegment(initialization);
  }
  return history_->ResultOf(index, map_);
}

void Odometry::StartSegment(const InitializationResult& initialization) {
  const int reference = initializer_->reference();
  std::vector<Frame> frames = initializer_->TakeFrames();
  Frame& first = frames[reference];
  Frame& second = frames.back();
  // A frame that was posed in the previous segment keeps that pose.
  const bool is_posed = history_->IsPosed(first.index);
  const std::optional<SO3> rotation = history_->RotationOf(first.index, map_);
  const bool is_new = !map_.empty() || !rotation || segment_ == kNoId;
  if (is_new) segment_ = std::max(segment_, map_.NewestSegment()) + 1;
  first.world_from_camera = PredictFirstPose(first, rotation, previous_, motion_->model());
  const std::optional<SpeedGuess> speed = motion_->StartSegment(second.time_ns);
  history_->SetScale(segment_, ScaleOf(speed));
  const InitialMap initial =
      ScaleToSpeed(*initialization.map, second.time_ns - first.time_ns, speed);
  const KeyframeId keyframe = mapper_->InsertInitialMap(initial, segment_, first, second, map_);
  history_->AddKeyframe(first.index, keyframe, map_);
  history_->AddKeyframe(second.index, keyframe + 1, map_);
  mapper_->Marginalize(map_, recorder_);
  const int num_points = static_cast<int>(initial.points.size());
  if (!is_posed) RecordPosed(first, initialization.num_matches, num_points);
  RecordPosed(second, initialization.num_matches, num_points);
  motion_->Add(first, second);
  LocalizePendingFrames(frames, reference, 1);
  LocalizePendingFrames(frames, reference, -1);
  previous_ = std::move(frames.back());
  state_ = State::kTracking;
}

void Odometry::LocalizePendingFrames(std::vector<Frame>& frames, int located, int step) {
  const PendingFrameLocator locator(*tracker_, motion_->model(), map_, *history_);
  for (const auto& [position, counts] : locator.Locate(frames, located, step)) {
    RecordPosed(frames[position], counts.num_matches, counts.num_inliers);
  }
}

void Odometry::RecordPosed(const Frame& frame, int num_matches, int num_inliers) {
  recorder_.RecordFrame(frame, segment_, map_);
  history_->SetTracked(frame, segment_, {num_matches, num_inliers}, map_);
  if (const auto uncertainty = mapper_->UncertaintyOf(frame, map_)) {
    history_->SetCovariance(frame.index, uncertainty->keyframe, uncertainty->covariance);
    history_->outcome(frame.index).health = uncertainty->health;
  }
}

void Odometry::RecordUnposed(int frame, const TrackingResult& tracking,
                             const InitializationResult& initialization) {
  FrameOutcome& outcome = history_->outcome(frame);
  ExplainUnposed(!map_.empty(), tracking, initialization, outcome);
  state_ = outcome.state;
  if (ChainRotation(frame, initialization, segment_ == kNoId, map_, *history_)) {
    segment_ = std::max(segment_, 0);
    outcome.state = State::kRotationOnly;
    outcome.reason = initialization.reason;
  }
  outcome.segment = segment_;
}

}  // namespace corvo
