// SPDX-License-Identifier: MIT
#include "apps/dataset/ros_image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/dataset/image_header.h"
#include "apps/dataset/image_reader.h"
#include "orb/error.h"

namespace corvo {
namespace {

constexpr int kIsGray = -1;

/// An encoding of sensor_msgs/Image: the type of its pixels and their conversion to gray.
struct Encoding {
  std::string_view name;
  int type = 0;
  int conversion = kIsGray;  ///< cv::ColorConversionCodes.
};

constexpr std::array<Encoding, 26> kEncodings = {{
    {"mono8", CV_8UC1},
    {"8UC1", CV_8UC1},
    {"mono16", CV_16UC1},
    {"16UC1", CV_16UC1},
    {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
    {"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
    {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
    {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
    {"8UC4", CV_8UC4, cv::COLOR_BGRA2GRAY},
    {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
    {"bgr16", CV_16UC3, cv::COLOR_BGR2GRAY},
    {"rgb16", CV_16UC3, cv::COLOR_RGB2GRAY},
    {"bgra16", CV_16UC4, cv::COLOR_BGRA2GRAY},
    {"rgba16", CV_16UC4, cv::COLOR_RGBA2GRAY},
    {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerRGGB2GRAY},
    {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerBGGR2GRAY},
    {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGBRG2GRAY},
    {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGRBG2GRAY},
    {"bayer_rggb16", CV_16UC1, cv::COLOR_BayerRGGB2GRAY},
    {"bayer_bggr16", CV_16UC1, cv::COLOR_BayerBGGR2GRAY},
    {"bayer_gbrg16", CV_16UC1, cv::COLOR_BayerGBRG2GRAY},
    {"bayer_grbg16", CV_16UC1, cv::COLOR_BayerGRBG2GRAY},
    {"yuv422", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
    {"uyvy", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
    {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
    {"yuyv", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
}};

const Encoding& EncodingOf(const BagImage& image, const std::string& name) {
  const auto* const found = std::ranges::find(kEncodings, image.encoding, &Encoding::name);
  if (found != kEncodings.end()) return *found;
  std::string known;
  for (const Encoding& encoding : kEncodings) known += fmt::format(" {}", encoding.name);
  throw Error(fmt::format("{}: encoding is '{}'; allowed are{}", name, image.encoding, known));
}

/// Throws corvo::Error unless the data have all rows, each of at least `row_size` bytes.
void CheckData(const BagImage& image, std::int64_t row_size, const std::string& name) {
  constexpr std::int64_t kMaxStep = std::numeric_limits<std::uint32_t>::max();  // As in messages.
  CheckRange(name + ": step", image.step, row_size, kMaxStep);
  const std::int64_t required = image.step * (image.height - 1) + row_size;
  if (static_cast<std::int64_t>(image.data.size()) >= required) return;
  throw Error(fmt::format("{}: has {} bytes; {} x {} px in {} with a step of {} bytes need {}",
                          name, image.data.size(), image.width, image.height, image.encoding,
                          image.step, required));
}

void SwapBytes(cv::Mat& image) {
  for (int y = 0; y < image.rows; ++y) {
    auto* const row = image.ptr<std::uint16_t>(y);
    std::transform(row, row + image.cols * image.channels(), row, [](std::uint16_t value) {
      return static_cast<std::uint16_t>(value << 8 | value >> 8);
    });
  }
}

/// Returns a copy of the pixels, without the padding of rows, in the byte order of this machine.
cv::Mat PixelsOf(const BagImage& image, int type, const std::string& name) {
  constexpr std::int64_t kMin = 1;
  CheckRange(name + ": width", image.width, kMin, kMaxImagePixels);
  CheckRange(name + ": height", image.height, kMin, kMaxImagePixels);
  CheckRange(name + ": number of pixels", image.width * image.height, kMin, kMaxImagePixels);
  CheckData(image, image.width * CV_ELEM_SIZE(type), name);
  const cv::Size size(static_cast<int>(image.width), static_cast<int>(image.height));
  const cv::Mat stored(size, type, const_cast<char*>(image.data.data()),
                       static_cast<std::size_t>(image.step));
  cv::Mat pixels = stored.clone();
  if (image.is_big_endian && pixels.depth() == CV_16U) SwapBytes(pixels);
  return pixels;
}

}  // namespace

cv::Mat RosImageToGray(const BagImage& image, const std::string& name) {
  if (image.encoding.empty()) return DecodeStoredGray(image.data, name);
  const Encoding& encoding = EncodingOf(image, name);
  const cv::Mat pixels = PixelsOf(image, encoding.type, name);
  if (encoding.conversion == kIsGray) return pixels;
  cv::Mat gray;
  cv::cvtColor(pixels, gray, encoding.conversion);
  return gray;
}

}  // namespace corvo
