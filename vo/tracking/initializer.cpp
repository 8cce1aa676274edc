// SPDX-License-Identifier: MIT
#include "vo/tracking/initializer.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "vo/geometry/rotation_estimator.h"
#include "vo/map/landmark_alignment.h"
#include "vo/map/map.h"
#include "vo/math/median.h"
#include "vo/optimization/bundle_adjuster.h"
#include "vo/tracking/frame_matching.h"

namespace corvo {
namespace {

/// Returns a map of two views in one segment, with the points of their motion as landmarks.
Map MakeTwoViewMap(const MeasurementModel& model, const TwoViewResult& motion,
                   const std::vector<orb::Match>& matches, Frame first, Frame second) {
  Map map(model);
  first.world_from_camera = SE3();
  second.world_from_camera = motion.first_from_second;
  for (Frame* frame : {&first, &second}) {
    frame->landmarks.assign(frame->landmarks.size(), kNoId);
    map.AddKeyframe(std::move(*frame), 0);
  }
  for (const TwoViewPoint& point : motion.points) {
    const orb::Match& match = matches[point.match];
    const LandmarkId id = map.AddLandmark(point.in_first, {{0, match.query}, {1, match.train}});
    AlignTrackElement(id, {1, match.train}, map);
  }
  return map;
}

/// Adjusts a map of two views. Returns the inlier points, or std::nullopt if the adjustment fails.
std::optional<InitialMap> AdjustTwoViews(const BundleAdjuster& adjuster, Map map) {
  const AdjustmentWindow window{{0, 1}, {}, map.FindObserved({0, 1})};
  Bundle bundle = CopyBundle(map, window);
  if (!adjuster.Adjust(map.camera(), bundle).is_usable()) return std::nullopt;
  WriteBack(bundle, map);
  InitialMap initial;
  initial.first_from_second = map.WorldFromKeyframe(1);
  for (const LandmarkId id : window.landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark == nullptr) continue;
    initial.points.push_back(
        {landmark->track[0].keypoint, landmark->track[1].keypoint, landmark->in_world});
  }
  return initial;
}

/// Scales a map so that the median depth in the first view is 1.
void NormalizeDepth(InitialMap& map) {
  std::vector<double> depths;
  for (const InitialPoint& point : map.points) depths.push_back(point.in_first.z());
  const double scale = 1 / Median(std::move(depths));
  map.first_from_second =
      SE3(map.first_from_second.rotation(), scale * map.first_from_second.translation());
  for (InitialPoint& point : map.points) point.in_first *= scale;
}

}  // namespace

Initializer::Initializer(const OdometryOptions& options, const MeasurementModel& model)
    : options_(options.initializer),
      matching_{options.matching.max_distance, options.initializer.max_ratio},
      adjuster_(WindowAdjustment(options.bundle_adjuster)),
      model_(model) {}

void Initializer::SetCamera(const Camera& camera) {
  model_.camera = camera;
  for (Frame& frame : frames_) UpdateRays(camera, frame);
}

void Initializer::RemoveMasked(const cv::Mat& mask) {
  for (Frame& frame : frames_) RemoveMaskedKeypoints(mask, frame);
  planes_ = PlaneHypotheses();
}

void Initializer::StartFrom(Frame posed) {
  Keep(std::move(posed));
  has_rotation_.back() = true;
}

InitializationResult Initializer::AddFrame(Frame frame) {
  frame.landmarks.assign(frame.landmarks.size(), kNoId);
  Keep(std::move(frame));
  InitializationResult result;
  const Frame& newest = frames_.back();
  if (newest.num_keypoints() < options_.min_matches) {
    result.reason = Reason::kTooFewFeatures;
    return result;
  }
  const Frame& reference = frames_[reference_];
  result.reference = reference.index;
  if (&reference == &newest || reference.num_keypoints() < options_.min_matches) {
    reference_ = static_cast<int>(frames_.size()) - 1;
    result.reference = newest.index;
    result.reason = Reason::kReferenceFrame;
    return result;
  }
  const std::vector<orb::Match> matches = MatchFrames(reference, newest, matching_);
  result.num_matches = static_cast<int>(matches.size());
  MakeMap(matches, result);
  if (!result.map && !result.reference_from_newest) ContinueRotation(result);
  has_rotation_.back() = result.reference_from_newest.has_value();
  if (result.num_matches < options_.min_matches) MoveReference();
  return result;
}

void Initializer::Keep(Frame frame) {
  frames_.push_back(std::move(frame));
  has_rotation_.push_back(false);
  if (static_cast<int>(frames_.size()) <= options_.max_waiting_frames) return;
  frames_.pop_front();
  has_rotation_.pop_front();
  reference_ = std::max(0, reference_ - 1);
}

void Initializer::MakeMap(const std::vector<orb::Match>& matches, InitializationResult& result) {
  const Frame& first = frames_[reference_];
  const Frame& second = frames_.back();
  const TwoViewResult motion = EstimateMotion(matches);
  result.reason = motion.reason;
  result.num_inliers = motion.num_inliers;
  result.parallax_deg = motion.parallax_deg;
  if (motion.first_from_second_rotation) {
    result.reference_from_newest = RefineRotation(first, *motion.first_from_second_rotation);
  }
  if (motion.reason != Reason::kNone) return;
  std::optional<InitialMap> map =
      AdjustTwoViews(adjuster_, MakeTwoViewMap(model_, motion, matches, first, second));
  if (!map || static_cast<int>(map->points.size()) < options_.min_points) {
    result.reason = Reason::kBadTriangulation;
    return;
  }
  NormalizeDepth(*map);
  result.map = std::move(map);
}

TwoViewResult Initializer::EstimateMotion(const std::vector<orb::Match>& matches) {
  const std::vector<RayMatch> rays = ToRayMatches(frames_[reference_], matches);
  TwoViewResult motion = EstimateTwoViewMotion(rays, options_);
  if (motion.reason != Reason::kPlanar) return motion;
  const std::vector<PlanarMotion> kept =
      planes_.Keep(frames_[reference_].index, motion.planar_motions, options_.max_plane_change_deg);
  return kept.size() == 1 ? TriangulatePlanarMotion(rays, kept.front(), options_) : motion;
}

void Initializer::ContinueRotation(InitializationResult& result) const {
  const auto last = std::find(has_rotation_.rbegin(), has_rotation_.rend(), true);
  if (last == has_rotation_.rend()) return;
  const Frame& known = frames_[std::distance(last, has_rotation_.rend()) - 1];
  const std::vector<orb::Match> matches = MatchFrames(known, frames_.back(), matching_);
  const TwoViewResult motion = CheckPureRotation(ToRayMatches(known, matches), options_);
  if (!motion.first_from_second_rotation) return;
  result.reference = known.index;
  result.reference_from_newest = RefineRotation(known, *motion.first_from_second_rotation);
  result.reason = motion.reason;
}

SO3 Initializer::RefineRotation(const Frame& reference, const SO3& reference_from_newest) const {
  const RotatedFrames views{reference, frames_.back(), reference_from_newest.Inverse()};
  const std::vector<orb::Match> keypoints =
      MatchRotatedFrames(views, model_, options_.rotation_search_radius_px, matching_);
  std::vector<RayMatch> matches = ToRayMatches(reference, keypoints);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto aligned =
        AlignRotatedMatch(views.first, views.second, keypoints[i], views.second_from_first, model_);
    if (!aligned) continue;
    matches[i].second = *aligned;
    matches[i].sigma *= model_.options.aligned_sigma_px / model_.options.keypoint_sigma_px;
  }
  if (static_cast<int>(matches.size()) < options_.min_refinement_matches) {
    return reference_from_newest;
  }
  return corvo::RefineRotation(matches, EstimateRotation(matches), options_.common_parallax)
      .Inverse();
}

std::vector<Frame> Initializer::TakeFrames() {
  std::vector<Frame> frames(std::make_move_iterator(frames_.begin()),
                            std::make_move_iterator(frames_.end()));
  frames_.clear();
  has_rotation_.clear();
  reference_ = 0;
  return frames;
}

std::size_t Initializer::num_bytes() const {
  std::size_t num_bytes = 0;
  for (const Frame& frame : frames_) num_bytes += NumBytes(frame);
  return num_bytes;
}

void Initializer::MoveReference() {
  const int newest = static_cast<int>(frames_.size()) - 1;
  const int half_way = reference_ + (newest - reference_ + 1) / 2;
  int nearest = kNoId;
  for (int i = reference_ + 1; i <= newest; ++i) {
    const bool is_nearer =
        nearest == kNoId || std::abs(i - half_way) < std::abs(nearest - half_way);
    if (has_rotation_[i] && is_nearer) nearest = i;
  }
  reference_ = nearest != kNoId ? nearest : half_way;
}

std::vector<RayMatch> Initializer::ToRayMatches(const Frame& first,
                                                const std::vector<orb::Match>& matches) const {
  const Frame& second = frames_.back();
  std::vector<RayMatch> rays;
  for (const orb::Match& match : matches) {
    const double sigma_px =
        std::max(model_.Sigma(first, match.query), model_.Sigma(second, match.train));
    const Eigen::Vector2d& first_ray = first.rays[match.query];
    const Eigen::Vector2d& second_ray = second.rays[match.train];
    const double focal =
        std::min(model_.camera.FocalAt(first_ray), model_.camera.FocalAt(second_ray));
    rays.push_back({first_ray, second_ray, sigma_px / focal});
  }
  return rays;
}

}  // namespace corvo
