// SPDX-License-Identifier: MIT
#include "vo/geometry/planar_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace corvo {
namespace {

double AngleDeg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

/// Returns the share of the inliers' rays that meet the plane in front of the first camera.
double ShareBeforePlane(const Eigen::Vector3d& normal, const std::vector<RayMatch>& matches,
                        const std::vector<char>& is_inlier) {
  int num_inliers = 0, num_in_front = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!is_inlier[i]) continue;
    ++num_inliers;
    num_in_front += normal.dot(matches[i].first.homogeneous()) > 0;
  }
  return num_inliers == 0 ? 0 : static_cast<double>(num_in_front) / num_inliers;
}

bool HasSimilar(const std::vector<Eigen::Vector3d>& normals, const Eigen::Vector3d& normal,
                double max_angle_deg) {
  return std::any_of(normals.begin(), normals.end(), [&](const Eigen::Vector3d& other) {
    return AngleDeg(other, normal) <= max_angle_deg;
  });
}

std::vector<Eigen::Vector3d> NormalsOf(const std::vector<PlanarMotion>& motions) {
  std::vector<Eigen::Vector3d> normals;
  for (const PlanarMotion& motion : motions) normals.push_back(motion.normal_in_first);
  return normals;
}

}  // namespace

std::vector<PlanarMotion> DecomposeHomography(const Eigen::Matrix3d& homography,
                                              const std::vector<RayMatch>& matches,
                                              const std::vector<char>& is_inlier,
                                              double min_share_before_plane) {
  constexpr double kSamePlaneDeg = 1;  // For a motion along the normal, both solutions coincide.
  cv::Mat matrix;
  cv::eigen2cv(homography, matrix);
  std::vector<cv::Mat> rotations, translations, normals;
  // The sign of the matrix does not matter: rotations are returned, not reflections.
  cv::decomposeHomographyMat(matrix, cv::Mat::eye(3, 3, CV_64F), rotations, translations, normals);
  std::vector<PlanarMotion> motions;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation, normal;
    cv::cv2eigen(rotations[i], rotation);
    cv::cv2eigen(translations[i], translation);
    cv::cv2eigen(normals[i], normal);
    if (translation.norm() == 0) continue;
    if (ShareBeforePlane(normal, matches, is_inlier) < min_share_before_plane) continue;
    if (HasSimilar(NormalsOf(motions), normal, kSamePlaneDeg)) continue;
    motions.push_back({SE3(SO3(rotation), translation), normal});
  }
  return motions;
}

std::vector<PlanarMotion> PlaneHypotheses::Keep(int reference,
                                                const std::vector<PlanarMotion>& motions,
                                                double max_angle_deg) {
  if (reference != reference_) normals_.clear();
  reference_ = reference;
  std::vector<PlanarMotion> kept;
  for (const PlanarMotion& motion : motions) {
    if (HasSimilar(normals_, motion.normal_in_first, max_angle_deg)) kept.push_back(motion);
  }
  normals_ = NormalsOf(kept.empty() ? motions : kept);
  return kept;
}

}  // namespace corvo
