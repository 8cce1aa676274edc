// SPDX-License-Identifier: MIT
#include "vo/mapping/keyframe_edges.h"

#include <algorithm>
#include <cmath>

#include "vo/map/landmark_covariance.h"

namespace corvo {
namespace {

constexpr int kMinShared = 15;    // Landmarks that two covisible keyframes share.
constexpr int kMaxCovisible = 3;  // Edges of a keyframe beside that to the one before it.
// The variance of the scale over many edges, relative to the sum of their variances: landmarks that
// several edges share hand their errors on. Measured over 10 edges: docs/uncertainty.md.
constexpr double kScaleCorrelation = 2;

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
    Edge& edge = edges_[{newest, earlier}];
    edge.segment = map.SegmentOf(newest);
    edge.covariance.topLeftCorner<6, 6>() = uncertainty.Between(map, earlier, newest, camera);
    edge.covariance(6, 6) =
        kScaleCorrelation * uncertainty.factor() * LogScaleVariance(map, earlier, newest);
  }
}

KeyframeEdges::Edge KeyframeEdges::Renewed(const Edge& before,
                                           const KeyframeInnovations& innovations, int first,
                                           int second, double factor) {
  PoseGraphEdge::Matrix7X by_innovations = innovations.ByInnovations(first, second);
  if (!innovations.KnowsScale(second)) by_innovations.row(6).setZero();
  Edge edge = before;
  edge.by_camera = innovations.ByCamera(by_innovations);
  by_innovations.row(6) *= std::sqrt(kScaleCorrelation);
  edge.covariance = factor * by_innovations * by_innovations.transpose();
  if (!innovations.KnowsScale(second)) edge.covariance(6, 6) = before.covariance(6, 6);
  return edge;
}

void KeyframeEdges::Renew(const Map& map, const PoseUncertainty& uncertainty,
                          const CameraEstimate& camera) {
  const KeyframeCovariance& joint = uncertainty.joint();
  if (joint.keyframes.empty()) return;
  std::vector<SE3> poses;
  for (const KeyframeId id : joint.keyframes) poses.push_back(map.WorldFromKeyframe(id));
  const KeyframeInnovations innovations(joint, poses);
  for (auto edge = edges_.lower_bound({joint.keyframes.front(), 0}); edge != edges_.end(); ++edge) {
    const int first = joint.Find(edge->first.second), second = joint.Find(edge->first.first);
    if (first == kNoId || second == kNoId) continue;
    edge->second = Renewed(edge->second, innovations, first, second, uncertainty.factor());
    const PoseGraphEdge::Matrix7X& by_camera = edge->second.by_camera;
    if (by_camera.cols() == 0) continue;
    edge->second.covariance += by_camera * camera.covariance * by_camera.transpose();
  }
}

void KeyframeEdges::JoinSegments(const SegmentJoin& join) {
  for (auto& [keyframes, edge] : edges_) {
    if (edge.segment != join.later) continue;
    edge.segment = join.earlier;
    ScaleLengths(join.earlier_from_later.scale(), edge.covariance, edge.by_camera);
  }
}

std::size_t KeyframeEdges::num_bytes() const {
  std::size_t sum = 0;
  for (const auto& [keyframes, edge] : edges_) {
    sum += sizeof(Edges::value_type) +
           static_cast<std::size_t>(edge.by_camera.size()) * sizeof(double);
  }
  return sum;
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
    added.covariance = num_edges[second] * edge.covariance;
    added.by_camera = edge.by_camera;
  }
  return graph;
}

}  // namespace corvo
