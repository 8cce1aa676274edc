// SPDX-License-Identifier: MIT
#include "apps/output/image_file.h"

#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "orb/error.h"

namespace corvo {

std::string EncodeImage(const cv::Mat& image, const std::string& extension) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(extension, image, bytes)) {
    throw Error(fmt::format("an image cannot be encoded as {}", extension));
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace corvo
