// SPDX-License-Identifier: MIT
#include "apps/dataset/packet_size.h"

#include <string_view>

#include "apps/dataset/image_header.h"

namespace corvo {

namespace {

/// Returns whether there is a next packet.
bool Read(VideoInput& packets, cv::Mat& packet) {
  return packets.Grab() && packets.Retrieve(packet) && !packet.empty();
}

}  // namespace

PacketSizes::PacketSizes(const std::filesystem::path& file)
    : packets_(GetCodecs().OpenPackets(file.string())) {
  if (!packets_) return;
  cv::Mat packet;
  const bool is_jpeg = Read(*packets_, packet) && packet.isContinuous() && packet.total() > 2 &&
                       packet.data[0] == 0xFF && packet.data[1] == 0xD8;
  packets_.reset();
  if (is_jpeg) packets_ = GetCodecs().OpenPackets(file.string());  // At the first packet again.
}

std::optional<cv::Size> PacketSizes::Next() {
  cv::Mat packet;
  if (!packets_ || !Read(*packets_, packet)) return std::nullopt;
  const auto header = ParseImageHeader(
      std::string_view(reinterpret_cast<const char*>(packet.data), packet.total()));
  if (!header) return std::nullopt;
  return cv::Size(static_cast<int>(header->width), static_cast<int>(header->height));
}

}  // namespace corvo
