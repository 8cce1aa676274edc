// SPDX-License-Identifier: MIT
#include "apps/output/error_text.h"

#include <filesystem>
#include <new>

#include <opencv2/core.hpp>

namespace corvo {

std::string ErrorText(const std::exception& error) {
  const auto* const image_error = dynamic_cast<const cv::Exception*>(&error);
  const bool is_out_of_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
                                (image_error && image_error->code == cv::Error::StsNoMem);
  if (is_out_of_memory) return "out of memory";
  const auto* const file_error = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (file_error) return file_error->path1().string() + ": " + file_error->code().message();
  const std::string text = error.what();
  return text.substr(0, text.find('\n'));
}

}  // namespace corvo
