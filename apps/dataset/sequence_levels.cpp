// SPDX-License-Identifier: MIT
#include "apps/dataset/sequence_levels.h"

#include <utility>

#include <fmt/format.h>

#include "apps/output/log_once.h"
#include "orb/error.h"

namespace corvo {

SequenceLevels::SequenceLevels(StoredImages stored, std::optional<int> bits)
    : stored_(std::move(stored)) {
  if (bits) stated_ = GrayLevels(*bits);
}

cv::Mat SequenceLevels::ToByte(const cv::Mat& image) {
  if (image.depth() != CV_16U) return image;
  if (!levels_) levels_ = stated_ ? *stated_ : Find();
  return levels_->ToByte(image);
}

GrayLevels SequenceLevels::Find() const {
  constexpr int kMaxImages = 8;
  GrayHistogram histogram;
  const int step = (stored_.count + kMaxImages - 1) / kMaxImages;
  for (int i = 0; i < stored_.count; i += step) {
    try {
      const cv::Mat image = stored_.read(i);
      if (image.depth() == CV_16U) histogram.Add(image);
    } catch (const Error&) {  // It is named when the sequence gets there.
    }
  }
  const GrayLevels levels = histogram.Levels();
  LogOnce(spdlog::level::info, fmt::format("{}: 16-bit images; used are {} (--bits changes that)",
                                           stored_.name, levels.text()));
  return levels;
}

}  // namespace corvo
