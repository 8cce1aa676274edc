#include "vo/odometry.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/map/landmark_alignment.h"
#include "vo/mapping/culling.h"
#include "vo/mapping/keyframe_policy.h"
#include "vo/tracking/relocalizer.h"

namespace corvo {
namespace {

/// Adds the time of its scope to a stage.
class StageTimer {
 public:
  explicit StageTimer(double& total_ms) : total_ms_(total_ms) {}
  ~StageTimer() {
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start_;
    total_ms_ += elapsed.count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& total_ms_;
  Clock::time_point start_ = Clock::now();
};

const OdometryOptions& Validated(const OdometryOptions& options) {
  options.Validate();
  return options;
}

/// Landmarks of a keyframe that enough keyframes see: three, or two while its segment has no more.
int CountEstablished(const Map& map, KeyframeId id) {
  const KeyframeId third_newest = map.num_keyframes() - 3;
  const bool has_three = third_newest >= 0 && map.SegmentOf(third_newest) == map.SegmentOf(id);
  const std::size_t min_observations = has_three ? 3 : 2;
  int count = 0;
  for (const LandmarkId landmark_id : map.keyframe(id).frame.landmarks) {
    const Landmark* landmark = map.FindLandmark(landmark_id);
    count += landmark != nullptr && landmark->observations.size() >= min_observations;
  }
  return count;
}

}  // namespace

Odometry::Odometry(const Camera& camera, const OdometryOptions& options, int threads)
    : Odometry(MakePrior(camera.parameters(), options.calibration), options, threads) {}

Odometry::Odometry(const CameraPrior& prior, const OdometryOptions& options, int threads)
    : options_(Validated(options)),
      threads_(threads),
      extractor_(options.extractor, threads),
      noise_{options.bundle_adjuster.keypoint_sigma_px, options.bundle_adjuster.aligned_sigma_px,
             extractor_.octave_scales()},
      initializer_(options.initializer, noise_, Camera(prior.given)),
      adjuster_(prior, options) {}

FrameResult Odometry::Process(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask) {
  CheckInput(image, time_ns);
  times_ = StageTimes();
  Frame frame = ExtractFrame(image, time_ns, mask);
  ContinueMapping(frame.index);
  const TrackingResult tracking = Track(frame);
  if (tracking.reason != Reason::kNone) return Initialize(std::move(frame), tracking);
  if (NeedsKeyframe(frame)) ExtendMap(frame);
  return Accept(std::move(frame), tracking);
}

void Odometry::Reset() {
  LandmarkSink landmark_sink = std::move(landmark_sink_);
  SightingsSink sightings_sink = std::move(sightings_sink_);
  *this = Odometry(camera_prior(), options_, threads_);
  landmark_sink_ = std::move(landmark_sink);
  sightings_sink_ = std::move(sightings_sink);
}

MemoryUse Odometry::memory_use() const {
  MemoryUse use;
  use.working_set_bytes = map_.working_set_bytes() + initializer_.num_bytes() + NumBytes(previous_);
  use.keyframe_bytes = map_.place_bytes();
  use.frame_bytes = records_.num_bytes();
  return use;
}

const Frame& Odometry::last_frame() const {
  const Frame* waiting = initializer_.newest();
  return waiting != nullptr ? *waiting : previous_;
}

void Odometry::CheckInput(const cv::Mat& image, TimeNs time_ns) const {
  if (image.type() != CV_8UC1) {
    throw Error(fmt::format("image has type {}; allowed is 8-bit with one channel (CV_8UC1)",
                            cv::typeToString(image.type())));
  }
  if (image.cols != camera().width() || image.rows != camera().height()) {
    throw Error(fmt::format("image is {}x{}; the camera says {}x{}", image.cols, image.rows,
                            camera().width(), camera().height()));
  }
  const Frame& last = last_frame();
  if (records_.size() > 0 && time_ns <= last.time_ns) {
    throw Error(fmt::format("time of frame {} is {} ns; it must be after the frame before, {} ns",
                            records_.size(), time_ns, last.time_ns));
  }
}

Frame Odometry::ExtractFrame(const cv::Mat& image, TimeNs time_ns, const cv::Mat& mask) {
  const StageTimer timer(times_.extract_ms);
  orb::Features features;
  std::vector<orb::Patch> patches;
  extractor_.Extract(image, mask, features, patches);
  Frame frame =
      MakeFrame(records_.size(), time_ns, std::move(features), camera(), std::move(patches));
  FrameOutcome result;
  result.index = frame.index;
  result.time_ns = time_ns;
  result.num_features = frame.num_keypoints();
  records_.Add(result);
  return frame;
}

TrackingResult Odometry::Track(Frame& frame) {
  const StageTimer timer(times_.locate_ms);
  TrackingResult tracking;
  tracking.reason = Reason::kReferenceFrame;
  if (!has_map()) return tracking;
  tracking = TrackFrame(map_, previous_, PredictPose(previous_, frame.time_ns), camera(), noise_,
                        options_.tracker, frame);
  const bool is_sure =
      state_ == State::kTracking || tracking.num_inliers >= options_.relocalizer.min_inliers;
  if (tracking.reason == Reason::kNone && is_sure) return tracking;
  return Relocalize(map_, segment_, camera(), noise_, options_.tracker, options_.relocalizer,
                    frame);
}

bool Odometry::NeedsKeyframe(const Frame& frame) const {
  KeyframeEvidence evidence;
  const std::vector<Covisible> covisible = map_.FindCovisible(frame);
  evidence.num_keypoints = frame.num_keypoints();
  evidence.num_tracked = CountSeenLandmarks(frame);
  evidence.num_reference = CountEstablished(map_, covisible.front().keyframe);
  return corvo::NeedsKeyframe(evidence, options_.keyframes);
}

void Odometry::ExtendMap(Frame& frame) {
  const StageTimer timer(times_.map_ms);
  const KeyframeId keyframe = map_.AddKeyframe(frame, segment_);
  landmark_builder_.Start(map_, keyframe, camera(), noise_, options_.keyframes);
  frame.landmarks = map_.keyframe(keyframe).frame.landmarks;
  records_.AddKeyframe(frame.index, keyframe, map_);
}

void Odometry::ContinueMapping(int frame) {
  TakeAdjustments(frame);
  const StageTimer timer(times_.map_ms);
  if (!has_map()) return;
  FinishLandmarks();
  adjuster_.Start(map_, noise_, frame);
}

void Odometry::FinishLandmarks() {
  const std::vector<LandmarkMerge> merges =
      landmark_builder_.Finish(map_, camera(), noise_, options_.keyframes);
  if (!sightings_sink_) return;
  untold_merges_.insert(untold_merges_.end(), merges.begin(), merges.end());
}

void Odometry::FinishMapping() {
  FinishLandmarks();
  TakeAdjustments(std::numeric_limits<int>::max());
}

void Odometry::TakeAdjustments(int frame) {
  const StageTimer timer(times_.adjust_ms);
  const Camera before = camera();
  if (!adjuster_.Finish(map_, frame)) return;
  if (camera() != before) {
    initializer_.SetCamera(camera());
    UpdateRays(camera(), previous_);
  }
  const KeyframeId newest = map_.num_keyframes() - 1;
  for (const KeyframeId retired : CullKeyframes(map_, newest, options_.keyframes)) {
    records_.RemoveKeyframe(retired, map_);
  }
  ArchiveKeyframes();
  if (records_.IsPosed(previous_.index)) {
    previous_.world_from_camera = records_.PoseOf(previous_.index, map_);
  }
}

void Odometry::ArchiveKeyframes() {
  const auto leaving = [this](const Keyframe& keyframe) { TellLeaving(keyframe); };
  for (const FinishedLandmark& landmark :
       corvo::ArchiveKeyframes(map_, options_.relocalizer.max_keyframes, leaving)) {
    if (landmark_sink_) landmark_sink_(landmark);
  }
}

Trajectory Odometry::Finish() {
  FinishMapping();
  if (!has_map()) return GetTrajectory();
  adjuster_.StartLastCalibration(map_, noise_, records_.size());
  FinishMapping();
  adjuster_.Start(map_, noise_, records_.size());
  FinishMapping();
  return GetTrajectory();
}

FrameResult Odometry::Accept(Frame frame, const TrackingResult& tracking) {
  for (const LandmarkId id : tracking.visible) {
    if (map_.FindLandmark(id) != nullptr) map_.CountVisible(id);
  }
  for (const LandmarkId id : frame.landmarks) {
    if (id != kNoId) map_.CountFound(id);
  }
  SetPosed(frame, tracking.num_matches, tracking.num_inliers);
  previous_.world_from_camera = records_.PoseOf(previous_.index, map_);
  SetMotion(previous_, frame);
  std::vector<Frame> frames = initializer_.TakeFrames();
  frames.push_back(std::move(frame));
  PlaceWaitingFrames(frames, static_cast<int>(frames.size()) - 1, -1);
  previous_ = std::move(frames.back());
  state_ = State::kTracking;
  return records_.ResultOf(previous_.index, map_);
}

FrameResult Odometry::Initialize(Frame frame, const TrackingResult& tracking) {
  const StageTimer timer(times_.locate_ms);
  const int index = frame.index;
  const TimeNs time_ns = frame.time_ns;
  frame.landmarks.assign(frame.landmarks.size(), kNoId);
  if (has_map() && initializer_.newest() == nullptr) initializer_.StartFrom(previous_);
  const InitializationResult initialization = initializer_.AddFrame(std::move(frame));
  SetUnposed(index, tracking, initialization);
  if (initialization.map && MayStartSegment(time_ns)) {
    FinishMapping();
    StartSegment(initialization);
  }
  return records_.ResultOf(index, map_);
}

void Odometry::SetUnposed(int frame, const TrackingResult& tracking,
                          const InitializationResult& initialization) {
  state_ = has_map() ? State::kLost : State::kInitializing;
  FrameOutcome& result = records_.outcome(frame);
  result.state = state_;
  const bool is_blank = initialization.reason == Reason::kTooFewFeatures;
  result.reason = has_map() && !is_blank ? tracking.reason : initialization.reason;
  result.num_matches = has_map() ? tracking.num_matches : initialization.num_matches;
  result.num_inliers = has_map() ? tracking.num_inliers : initialization.num_inliers;
  result.parallax_deg = initialization.parallax_deg;
  SetRotation(frame, initialization);
  result.segment = segment_;
}

void Odometry::SetRotation(int frame, const InitializationResult& initialization) {
  if (segment_ == kNoId && initialization.reason == Reason::kReferenceFrame) {
    records_.SetRotation(frame, frame, SO3());
  }
  if (!initialization.reference_from_newest) return;
  records_.SetRotation(frame, initialization.reference, *initialization.reference_from_newest);
  if (!records_.RotationOf(frame, map_)) return;
  segment_ = std::max(segment_, 0);
  records_.outcome(frame).state = State::kRotationOnly;
  records_.outcome(frame).reason = initialization.reason;
}

bool Odometry::MayStartSegment(TimeNs time_ns) const {
  const auto lost_s = static_cast<double>(time_ns - previous_.time_ns) * 1e-9;
  return !has_map() || lost_s >= options_.relocalizer.max_lost_s;
}

void Odometry::StartSegment(const InitializationResult& initialization) {
  const InitialMap& initial = *initialization.map;
  const int reference = initializer_.reference();
  std::vector<Frame> frames = initializer_.TakeFrames();
  Frame& first = frames[reference];
  Frame& second = frames.back();
  first.world_from_camera = PredictStart(first);
  first.landmarks.assign(first.landmarks.size(), kNoId);
  const double scale = ChainScale(initial, second.time_ns - first.time_ns);
  second.world_from_camera =
      first.world_from_camera *
      SE3(initial.first_from_second.rotation(), scale * initial.first_from_second.translation());
  const bool continues = !has_map() && records_.RotationOf(first.index, map_);
  if (!continues || segment_ == kNoId) ++segment_;
  const bool is_posed = records_.IsPosed(first.index);  // In the segment before; there it stays.
  AddInitialMap(initial, scale, first, second);
  const int num_points = static_cast<int>(initial.points.size());
  if (!is_posed) SetPosed(first, initialization.num_matches, num_points);
  SetPosed(second, initialization.num_matches, num_points);
  SetMotion(first, second);
  PlaceWaitingFrames(frames, reference, 1);
  PlaceWaitingFrames(frames, reference, -1);
  previous_ = std::move(frames.back());
  state_ = State::kTracking;
}

/// Turned as it was tracked and standing where it was last, if its rotation is known; otherwise at
/// constant velocity.
SE3 Odometry::PredictStart(const Frame& first) const {
  const std::optional<SO3> rotation = records_.RotationOf(first.index, map_);
  if (rotation) return SE3(*rotation, previous_.world_from_camera.translation());
  return PredictPose(previous_, first.time_ns);
}

void Odometry::AddInitialMap(const InitialMap& initial, double scale, Frame& first, Frame& second) {
  const KeyframeId first_id = map_.AddKeyframe(first, segment_);
  const KeyframeId second_id = map_.AddKeyframe(second, segment_);
  for (const InitialPoint& point : initial.points) {
    const Eigen::Vector3d in_world =
        first.world_from_camera * Eigen::Vector3d(scale * point.in_first);
    const LandmarkId id = map_.AddLandmark(
        in_world, {{first_id, point.first_keypoint}, {second_id, point.second_keypoint}});
    AlignObservation(id, {second_id, point.second_keypoint}, camera(), noise_.octave_scales, map_);
    map_.UpdateAppearance(id, noise_.octave_scales);
    landmark_builder_.AddOnTrial(id);
  }
  for (const KeyframeId id : {first_id, second_id}) {
    Frame& frame = id == first_id ? first : second;
    frame.landmarks = map_.keyframe(id).frame.landmarks;
    records_.AddKeyframe(frame.index, id, map_);
  }
  ArchiveKeyframes();
}

void Odometry::PlaceWaitingFrames(std::vector<Frame>& frames, int located, int step) {
  const int num_frames = static_cast<int>(frames.size());
  for (int i = located + step; i >= 0 && i < num_frames; i += step) {
    Frame& frame = frames[i];
    if (records_.IsPosed(frame.index)) break;
    const SE3 predicted = PredictPose(frames[located], frame.time_ns);
    const TrackingResult tracking =
        TrackFrame(map_, frames[located], predicted, camera(), noise_, options_.tracker, frame);
    if (tracking.reason != Reason::kNone) continue;
    SetPosed(frame, tracking.num_matches, tracking.num_inliers);
    located = i;
  }
}

SE3 Odometry::PredictPose(const Frame& from, TimeNs time_ns) const {
  if (step_ns_ == 0) return from.world_from_camera;
  const double steps = static_cast<double>(time_ns - from.time_ns) / static_cast<double>(step_ns_);
  return from.world_from_camera * motion_.Power(steps);
}

/// So that the speed over the first baseline is the last one known.
double Odometry::ChainScale(const InitialMap& initial, TimeNs baseline_ns) const {
  if (step_ns_ == 0) return 1;
  const double distance = motion_.translation().norm() * static_cast<double>(baseline_ns) /
                          static_cast<double>(step_ns_);
  return distance > 0 ? distance / initial.first_from_second.translation().norm() : 1;
}

void Odometry::SetMotion(const Frame& from, const Frame& to) {
  motion_ = from.world_from_camera.Inverse() * to.world_from_camera;
  step_ns_ = to.time_ns - from.time_ns;
}

void Odometry::SetPosed(const Frame& frame, int num_matches, int num_inliers) {
  FrameOutcome& result = records_.outcome(frame.index);
  result.state = State::kTracking;
  result.reason = Reason::kNone;
  result.segment = segment_;
  result.num_matches = num_matches;
  result.num_inliers = num_inliers;
  TellPosed(frame);
  if (!result.is_keyframe) {
    records_.SetPose(frame.index, segment_, frame.world_from_camera, map_);
  }
}

void Odometry::AddSighting(const Frame& frame, int keypoint, FrameSightings& sightings) const {
  const Landmark* landmark = map_.FindLandmark(frame.landmarks[keypoint]);
  if (landmark == nullptr) return;
  sightings.landmarks.push_back({landmark->id, frame.pixel(keypoint).cast<float>(),
                                 static_cast<float>(noise_.Sigma(frame, keypoint))});
  if (sightings.keyframe != kNoId) sightings.in_world.push_back(landmark->in_world);
}

FrameSightings Odometry::SightingsOf(const Frame& frame, int segment, KeyframeId keyframe) const {
  FrameSightings sightings{frame.index, segment, keyframe, {}, {}, {}};
  for (int k = 0; k < frame.num_keypoints(); ++k) AddSighting(frame, k, sightings);
  return sightings;
}

void Odometry::TellPosed(const Frame& frame) {
  if (!sightings_sink_) return;
  FrameSightings sightings = SightingsOf(frame, segment_, kNoId);
  sightings.merges.swap(untold_merges_);
  sightings_sink_(sightings);
}

void Odometry::TellLeaving(const Keyframe& keyframe) const {
  if (!sightings_sink_) return;
  sightings_sink_(SightingsOf(keyframe.frame, keyframe.segment, keyframe.id));
  std::map<KeyframeId, FrameSightings> last;
  for (const LandmarkId id : keyframe.frame.landmarks) {
    const Landmark* landmark = map_.FindLandmark(id);
    if (landmark == nullptr || landmark->observations.size() > 2) continue;
    for (const Observation& o : landmark->observations) {
      if (o.keyframe == keyframe.id) continue;
      const Frame& other = map_.keyframe(o.keyframe).frame;
      const FrameSightings none{other.index, keyframe.segment, o.keyframe, {}, {}, {}};
      AddSighting(other, o.keypoint, last.try_emplace(o.keyframe, none).first->second);
    }
  }
  for (const auto& [other, sightings] : last) sightings_sink_(sightings);
}

void Odometry::VisitKeyframes(const SightingsSink& visit) const {
  for (const KeyframeId id : map_.KeptKeyframes()) {
    visit(SightingsOf(map_.keyframe(id).frame, map_.SegmentOf(id), id));
  }
}

}  // namespace corvo
