// SPDX-License-Identifier: MIT
#include "apps/output/image_file.h"

#include <vector>

#include <fmt/format.h>

#include "apps/codecs/codecs.h"
#include "orb/error.h"

namespace corvo {

std::string EncodeImage(const cv::Mat& image, const std::string& extension) {
  const std::vector<std::uint8_t> bytes = GetCodecs().EncodeImage(extension, image);
  if (bytes.empty()) {
    throw Error(fmt::format("an image cannot be encoded as {}", extension));
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace corvo
