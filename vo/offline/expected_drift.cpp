// SPDX-License-Identifier: MIT
#include "vo/offline/expected_drift.h"

#include <cmath>
#include <map>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

namespace corvo {
namespace {

using Vector3 = Eigen::Vector3d;
using Matrix7 = PoseGraphEdge::Matrix7;
using Matrix7X = PoseGraphEdge::Matrix7X;
using Vector7 = Eigen::Matrix<double, 7, 1>;

/// An infinitesimal similarity: how it moves the point q.
struct Motion {
  Vector3 shift = Vector3::Zero(), turn = Vector3::Zero();
  double stretch = 0;

  Vector3 At(const Vector3& q) const { return shift + turn.cross(q) + stretch * q; }
};

/// Returns a factor L of the covariance: L L^T = C.
template <typename Matrix>
Matrix RootOf(const Matrix& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// The errors of a keyframe relative to the one before it: L u + S v, u, v ~ N(0, I), where v is
/// the same for all keyframes.
struct EdgeError {
  Matrix7 independent = Matrix7::Zero();  // L
  Matrix7X common = Matrix7X(7, 0);       // S
};

/// The keyframes of one segment and the errors between them.
class Chain {
 public:
  void AddVertex(std::size_t index, const SE3& pose) {
    vertices_.push_back(index);
    poses_.push_back(pose);
  }

  /// Adds the error of the newest vertex relative to the one before it.
  void AddError(const EdgeError& error) { errors_.push_back({vertices_.size() - 1, error}); }

  void Solve(std::vector<double>& sigmas) {
    Center();
    std::vector<double> variances(poses_.size(), 0);
    AddIndependent(variances);
    AddCommon(variances);
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      sigmas[vertices_[k]] = std::sqrt(variances[k]);
    }
  }

 private:
  struct Error {
    std::size_t vertex = 0;  ///< It moves this vertex and all that follow.
    EdgeError parts;
  };

  void AddIndependent(std::vector<double>& variances) const {
    for (const Error& error : errors_) {
      for (int column = 0; column < 7; ++column) {
        std::vector<Vector3> moved(poses_.size(), Vector3::Zero());
        Move(error.vertex, error.parts.independent.col(column), moved);
        AddSquares(moved, variances);
      }
    }
  }

  void AddCommon(std::vector<double>& variances) const {
    std::vector<std::vector<Vector3>> common;  // Displacements by each column of S.
    for (const Error& error : errors_) {
      for (Eigen::Index column = 0; column < error.parts.common.cols(); ++column) {
        if (column == std::ssize(common)) common.emplace_back(poses_.size(), Vector3::Zero());
        Move(error.vertex, error.parts.common.col(column), common[column]);
      }
    }
    for (const std::vector<Vector3>& moved : common) AddSquares(moved, variances);
  }

  void Center() {
    Vector3 mean = Vector3::Zero();
    for (const SE3& pose : poses_) mean += pose.translation() / static_cast<double>(poses_.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const SE3& pose : poses_) {
      positions_.push_back(pose.translation() - mean);
      moments += positions_.back() * positions_.back().transpose();
    }
    square_sum_ = moments.trace();
    // A straight path does not determine the rotation about itself.
    turn_from_torque_ = (square_sum_ * Eigen::Matrix3d::Identity() - moments)
                            .completeOrthogonalDecomposition()
                            .pseudoInverse();
  }

  /// Moves a vertex and all that follow by an error [υ ω λ] in the axes of the vertex.
  void Move(std::size_t vertex, const Vector7& error, std::vector<Vector3>& moved) const {
    const SO3& rotation = poses_[vertex].rotation();
    const Vector3& origin = positions_[vertex];
    Motion motion;
    motion.turn = rotation * Vector3(error.segment<3>(3));
    motion.stretch = error[6];
    motion.shift =
        rotation * Vector3(error.head<3>()) - motion.turn.cross(origin) - motion.stretch * origin;
    for (std::size_t k = vertex; k < moved.size(); ++k) moved[k] += motion.At(positions_[k]);
  }

  /// Adds the squares of displacements after their alignment.
  void AddSquares(const std::vector<Vector3>& moved, std::vector<double>& variances) const {
    const Motion aligned = FitTo(moved);
    for (std::size_t k = 0; k < moved.size(); ++k) {
      variances[k] += (moved[k] - aligned.At(positions_[k])).squaredNorm();
    }
  }

  /// Returns the motion of all positions that is nearest to their displacements.
  Motion FitTo(const std::vector<Vector3>& moved) const {
    Vector3 sum = Vector3::Zero(), torque = Vector3::Zero();
    double divergence = 0;
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      sum += moved[k];
      torque += positions_[k].cross(moved[k]);
      divergence += positions_[k].dot(moved[k]);
    }
    Motion fit;
    fit.shift = sum / static_cast<double>(positions_.size());
    fit.turn = turn_from_torque_ * torque;
    fit.stretch = square_sum_ > 0 ? divergence / square_sum_ : 0;
    return fit;
  }

  std::vector<std::size_t> vertices_;
  std::vector<SE3> poses_;
  std::vector<Error> errors_;
  std::vector<Vector3> positions_;  // Relative to their mean.
  double square_sum_ = 0;
  Eigen::Matrix3d turn_from_torque_ = Eigen::Matrix3d::Zero();
};

/// Returns the parts of the error of an edge of the given covariance: what the camera causes, as
/// far as it is uncertain in the end, is common to all edges.
EdgeError PartsOf(const PoseGraphEdge& edge, const Matrix7& covariance,
                  const Eigen::MatrixXd& camera_root) {
  if (camera_root.size() == 0 || edge.by_camera.cols() != camera_root.rows()) {
    return {RootOf(covariance), Matrix7X(7, 0)};
  }
  const Matrix7X common = edge.by_camera * camera_root;
  return {RootOf(Matrix7(covariance - common * common.transpose())), common};
}

/// Returns the errors of the keyframes relative to the ones before them. All edges of a keyframe to
/// earlier ones share its observations, so that the covariance of each counts as many times; see
/// PoseGraph.
std::map<KeyframeId, EdgeError> ErrorsOf(const PoseGraph& graph) {
  std::map<KeyframeId, int> num_edges;
  std::map<KeyframeId, const PoseGraphEdge*> newest;
  for (const PoseGraphEdge& edge : graph.edges) {
    ++num_edges[edge.second];
    newest[edge.second] = &edge;  // Edges are in ascending order of `first`.
  }
  Eigen::MatrixXd camera_root;
  if (graph.camera_covariance.size() > 0) camera_root = RootOf(graph.camera_covariance);
  std::map<KeyframeId, EdgeError> errors;
  for (const auto& [keyframe, edge] : newest) {
    errors[keyframe] = PartsOf(*edge, edge->covariance / num_edges[keyframe], camera_root);
  }
  return errors;
}

}  // namespace

std::vector<double> ExpectedDrift(const PoseGraph& graph) {
  const std::map<KeyframeId, EdgeError> errors = ErrorsOf(graph);
  std::map<int, Chain> chains;  // By segment.
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    const PoseGraphVertex& vertex = graph.vertices[i];
    Chain& chain = chains[vertex.segment];
    chain.AddVertex(i, vertex.world_from_camera);
    const auto error = errors.find(vertex.keyframe);
    if (error != errors.end()) chain.AddError(error->second);
  }
  std::vector<double> sigmas(graph.vertices.size(), 0);
  for (auto& [segment, chain] : chains) chain.Solve(sigmas);
  return sigmas;
}

void SetExpectedDrift(const PoseGraph& graph, Trajectory& trajectory) {
  const std::vector<double> sigmas = ExpectedDrift(graph);
  std::map<int, std::map<int, double>> by_frame;  // Of each segment.
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    by_frame[graph.vertices[i].segment][graph.vertices[i].frame] = sigmas[i];
  }
  for (FrameResult& frame : trajectory.frames) {
    const auto sigmas_of_segment = by_frame.find(frame.segment);
    if (!frame.world_from_camera || sigmas_of_segment == by_frame.end()) continue;
    auto keyframe = sigmas_of_segment->second.upper_bound(frame.index);
    if (keyframe != sigmas_of_segment->second.begin()) --keyframe;
    frame.health.drift_sigma = keyframe->second;
  }
}

double ExpectedAte(const Trajectory& trajectory) {
  double sum = 0;
  int count = 0;
  for (const FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera) continue;
    sum += frame.health.drift_sigma * frame.health.drift_sigma;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

}  // namespace corvo
