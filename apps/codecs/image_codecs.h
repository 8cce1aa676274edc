// SPDX-License-Identifier: MIT
#pragma once

#include "apps/codecs/codecs.h"

namespace corvo {

/// The codecs of images, by OpenCV's module imgcodecs.
class ImageCodecs : public Codecs {
 public:
  cv::Mat DecodeImage(const std::string& bytes, int flags) const override;
  std::vector<std::uint8_t> EncodeImage(const std::string& extension,
                                        const cv::Mat& image) const override;
};

}  // namespace corvo
