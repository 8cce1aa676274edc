// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/calib3d.hpp>

namespace corvo {

/// Returns the parameters of OpenCV's robust estimators, with a fixed seed and one thread. Inliers
/// lie within `threshold` of the model, in the unit of the points.
inline cv::UsacParams MakeUsacParams(double threshold) {
  cv::UsacParams params;
  params.randomGeneratorState = 0;
  params.isParallel = false;
  params.confidence = 0.9999;
  params.maxIterations = 2000;
  params.threshold = threshold;
  params.sampler = cv::SAMPLING_UNIFORM;
  params.score = cv::SCORE_METHOD_MSAC;
  params.loMethod = cv::LOCAL_OPTIM_GC;
  params.loIterations = 10;
  params.loSampleSize = 50;
  return params;
}

}  // namespace corvo
