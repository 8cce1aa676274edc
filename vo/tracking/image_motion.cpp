// SPDX-License-Identifier: MIT
#include "vo/tracking/image_motion.h"

namespace corvo {

ImageMotion::Result ImageMotion::Add(const cv::Mat& image) {
  const ReducedImage reduced(image);
  if (repeats_.Add(reduced)) return {true, false};
  return {false, overlay_.Add(reduced)};
}

}  // namespace corvo
