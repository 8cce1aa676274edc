// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vo/camera/camera.h"
#include "vo/core/trajectory.h"
#include "vo/evaluation/evaluation.h"
#include "vo/offline/refiner.h"

namespace corvo::test {

/// The image and timestamp of a frame.
struct TimedImage {
  cv::Mat image;
  TimeNs time_ns = 0;
};
using ImageSource = std::function<TimedImage(int)>;

/// Runs Odometry with default options over frames 0 to num_frames - 1 and finishes it.
Trajectory RunOdometry(const ImageSource& source, int num_frames, const Camera& camera);

/// Like RunOdometry(), but refines the trajectory after the last frame.
Refinement RunAndRefine(const ImageSource& source, int num_frames, const Camera& camera);

/// Reads the ground truth of a KITTI sequence from the test data.
PoseSequence ReadKittiTruth(const std::string& sequence);

/// Evaluates the posed frames after a Sim3 alignment of the whole trajectory.
Evaluation EvaluatePosed(const Trajectory& trajectory, const PoseSequence& truth);

}  // namespace corvo::test
