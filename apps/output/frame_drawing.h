// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

#include "apps/output/path_inset.h"
#include "apps/output/track_history.h"
#include "vo/core/frame_result.h"
#include "vo/map/frame.h"

namespace corvo {

/// Returns the state of a frame in words, such as "tracking, 143 of 210 landmarks" or
/// "lost: too few inliers, 12 of 40 landmarks".
std::string StateText(const FrameResult& result);

/// Returns a gray image in color, tinted where `mask` is not empty and zero, with the frame's
/// keypoints. Those that observe a landmark are dots with a line through the track's last pixels,
/// in the color of its age; the others are small gray dots.
cv::Mat DrawTracks(const cv::Mat& image, const cv::Mat& mask, const Frame& frame,
                   const TrackHistory& tracks);

/// Returns the image with a bar below it: the index of the frame, its state in words (white, or
/// yellow if there is a reason) and the colors of ages.
cv::Mat WithCaption(const cv::Mat& image, const FrameResult& result);

}  // namespace corvo
