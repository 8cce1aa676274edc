// SPDX-License-Identifier: MIT
#include "apps/dataset/packet_size.h"

#include <string_view>

#include "apps/dataset/image_header.h"

namespace corvo {

namespace {

/// Returns an unopened capture on errors.
cv::VideoCapture OpenPackets(const std::filesystem::path& file) {
  try {
    return cv::VideoCapture(file.string(), cv::CAP_FFMPEG, {cv::CAP_PROP_FORMAT, -1});
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

PacketSizes::PacketSizes(const std::filesystem::path& file) : packets_(OpenPackets(file)) {
  cv::Mat packet;
  const bool is_jpeg = packets_.read(packet) && packet.isContinuous() && packet.total() > 2 &&
                       packet.data[0] == 0xFF && packet.data[1] == 0xD8;
  packets_.release();
  if (is_jpeg) packets_ = OpenPackets(file);  // At the first packet again.
}

std::optional<cv::Size> PacketSizes::Next() {
  cv::Mat packet;
  if (!packets_.isOpened() || !packets_.read(packet) || packet.empty()) return std::nullopt;
  const auto header = ParseImageHeader(
      std::string_view(reinterpret_cast<const char*>(packet.data), packet.total()));
  if (!header) return std::nullopt;
  return cv::Size(static_cast<int>(header->width), static_cast<int>(header->height));
}

}  // namespace corvo
