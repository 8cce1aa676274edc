// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/core/trajectory.h"
#include "vo/offline/metric_scale.h"

namespace corvo {

/// A distance between the positions of the camera at two frames.
struct KnownDistance {
  int first_frame = 0;
  int second_frame = 0;
  double meters = 0;
};

/// The two ends of an object in the image of one frame, px.
struct ObjectView {
  int frame = 0;
  Eigen::Vector2d first_end_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d second_end_px = Eigen::Vector2d::Zero();
};

/// The distance between the two ends of an object that does not move.
struct KnownSize {
  std::vector<ObjectView> views;  ///< At least two, from different positions.
  double meters = 0;
  double pixel_sigma = 1;  ///< Standard deviation of the pixels of the ends along each axis, px.
};

/// Returns the scale with which the positions of two frames have a known distance, as that of the
/// frame in the middle. Its standard deviation is 0. Throws corvo::Error if the frames have no
/// poses, are of different segments or have the same position, or unless the distance is finite and
/// above 0.
ScaleMeasurement MeasureScale(const Trajectory& trajectory, const KnownDistance& known);

/// Returns the scale with which an object has its size, as that of the frame in the middle of its
/// views. Each end is the point of least squared distances from its pixels; the standard deviation
/// of the scale follows from that of the pixels to first order (Hartley and Zisserman, Multiple
/// View Geometry, 5.2), and the poses count as exact. Throws corvo::Error if a frame has no pose or
/// is of another segment, if a pixel is outside the image, if there are not two views, if they
/// leave the size uncertain by half or do not agree within kMaxMissPx, or unless the size and the
/// standard deviation are finite and above 0.
ScaleMeasurement MeasureScale(const Trajectory& trajectory, const Camera& camera,
                              const KnownSize& known);

/// The largest distance between the pixel of an object's end and the point from all its views.
inline constexpr double kMaxMissPx = 10;

}  // namespace corvo
