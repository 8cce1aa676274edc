// SPDX-License-Identifier: MIT
#include "apps/codecs/image_codecs.h"

#include <opencv2/imgcodecs.hpp>

namespace corvo {

cv::Mat ImageCodecs::DecodeImage(const std::string& bytes, int flags) const {
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1,
                         const_cast<char*>(bytes.data()));
    return cv::imdecode(buffer, flags);
  } catch (const cv::Exception&) {
    return {};
  }
}

std::vector<std::uint8_t> ImageCodecs::EncodeImage(const std::string& extension,
                                                   const cv::Mat& image) const {
  std::vector<std::uint8_t> bytes;
  try {
    if (!cv::imencode(extension, image, bytes)) bytes.clear();
  } catch (const cv::Exception&) {
    bytes.clear();
  }
  return bytes;
}

}  // namespace corvo
