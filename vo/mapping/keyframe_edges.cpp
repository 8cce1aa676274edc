// SPDX-License-Identifier: MIT
#include "vo/mapping/keyframe_edges.h"

#include <algorithm>

#include "vo/map/landmark_covariance.h"

namespace corvo {
namespace {

constexpr int kMinShared = 15;    // Landmarks that two covisible keyframes share.
constexpr int kMaxCovisible = 3;  // Edges of a keyframe beside that to the one before it.

/// Returns the earlier keyframes that a keyframe gets edges to, the one before it first.
std::vector<KeyframeId> EarlierNeighbors(const Map& map, KeyframeId keyframe) {
  std::vector<KeyframeId> neighbors;
  const KeyframeId before = KeyframeBefore(map, keyframe);
  if (before == kNoId) return neighbors;
  neighbors.push_back(before);
  for (const Covisible& covisible : map.FindCovisible(keyframe, kMinShared)) {
    const KeyframeId other = covisible.keyframe;
    if (other >= before || map.SegmentOf(other) != map.SegmentOf(keyframe)) continue;
    neighbors.push_back(other);
    if (static_cast<int>(neighbors.size()) > kMaxCovisible) break;
  }
  return neighbors;
}

}  // namespace

double LogScaleVariance(const Map& map, KeyframeId first, KeyframeId second) {
  const Eigen::Vector3d center = map.WorldFromKeyframe(second).translation();
  double information = 0;
  for (const LandmarkId id : map.LandmarksOf(second)) {
    const Landmark& landmark = *map.FindLandmark(id);
    const bool is_shared = std::ranges::any_of(
        landmark.track, [&](const TrackElement& element) { return element.keyframe == first; });
    if (!is_shared) continue;
    const Eigen::Vector3d ray = landmark.in_world - center;
    const double along = ray.dot(LandmarkCovariance(map, landmark) * ray);
    information += ray.squaredNorm() * ray.squaredNorm() / along;
  }
  return 1 / std::max(1.0, information);
}

void KeyframeEdges::AddKeyframe(const Map& map, const PoseUncertainty& uncertainty,
                                const CameraEstimate& camera) {
  const KeyframeId newest = map.num_keyframes() - 1;
  frames_[newest] = map.keyframe(newest).frame.index;
  for (const KeyframeId earlier : EarlierNeighbors(map, newest)) {
    frames_.try_emplace(earlier, map.keyframe(earlier).frame.index);
    edges_[{newest, earlier}] = {map.SegmentOf(newest),
                                 uncertainty.Between(map, earlier, newest, camera),
                                 uncertainty.factor() * LogScaleVariance(map, earlier, newest)};
  }
}

void KeyframeEdges::Renew(const Map& map, const PoseUncertainty& uncertainty,
                          const CameraEstimate& camera) {
  const std::vector<KeyframeId>& keyframes = uncertainty.keyframes();
  if (keyframes.empty()) return;
  for (auto edge = edges_.lower_bound({keyframes.front(), 0}); edge != edges_.end(); ++edge) {
    const auto [second, first] = edge->first;
    if (!std::ranges::binary_search(keyframes, first)) continue;
    if (!std::ranges::binary_search(keyframes, second)) continue;
    edge->second.covariance = uncertainty.Between(map, first, second, camera);
  }
}

void KeyframeEdges::JoinSegments(const SegmentJoin& join) {
  for (auto& [keyframes, edge] : edges_) {
    if (edge.segment != join.later) continue;
    edge.segment = join.earlier;
    edge.covariance = ScaleCovariance(join.earlier_from_later.scale(), edge.covariance);
  }
}

PoseGraph KeyframeEdges::ToGraph(const Map& map) const {
  PoseGraph graph;
  for (const auto& [id, frame] : frames_) {
    graph.vertices.push_back({id, frame, map.SegmentOf(id), map.WorldFromKeyframe(id)});
  }
  std::map<KeyframeId, int> num_edges;
  for (const auto& [keyframes, edge] : edges_) ++num_edges[keyframes.first];
  for (const auto& [keyframes, edge] : edges_) {
    const auto [second, first] = keyframes;
    PoseGraphEdge& added = graph.edges.emplace_back();
    added.first = first;
    added.second = second;
    added.first_from_second =
        map.WorldFromKeyframe(first).Inverse() * map.WorldFromKeyframe(second);
    added.covariance.topLeftCorner<6, 6>() = num_edges[second] * edge.covariance;
    added.covariance(6, 6) = num_edges[second] * edge.log_scale_variance;
  }
  return graph;
}

}  // namespace corvo
