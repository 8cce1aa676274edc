// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/codecs/codecs.h"
#include "apps/dataset/image_header.h"
#include "apps/dataset/image_reader.h"
#include "apps/output/log_once.h"
#include "apps/system/decoder_messages.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns whether the bytes are a truncated JPEG, whose missing part decoders silently fill with
/// gray. A complete JPEG has an end-of-image marker after its last start-of-scan marker; scan data
/// contain neither marker.
bool IsTruncatedJpeg(const std::string& bytes) {
  if (bytes.compare(0, 2, "\xFF\xD8") != 0) return false;
  const std::size_t scan = bytes.rfind("\xFF\xDA");
  const std::size_t end = bytes.rfind("\xFF\xD9");
  return scan == std::string::npos || end == std::string::npos || end < scan;
}

/// Returns whether the bytes are a PNG without its last chunk, IEND.
bool IsTruncatedPng(const std::string& bytes) {
  return bytes.compare(0, 4, "\x89PNG") == 0 && bytes.rfind("IEND") == std::string::npos;
}

/// Throws corvo::Error if the header says that the image is too large to be decoded.
void CheckHeader(const ImageHeader& header, const std::string& name) {
  if (header.num_pixels() <= kMaxImagePixels) return;
  throw Error(fmt::format("{}: the image is {} x {} px, {} in total; allowed is 1 to {}", name,
                          header.width, header.height, header.num_pixels(), kMaxImagePixels));
}

void WarnOfOrientation(const ImageHeader& header, const std::string& name) {
  if (header.orientation == 1) return;
  LogOnce(
      spdlog::level::warn,
      fmt::format("{}: has the EXIF orientation {}, which is ignored: this and all other images "
                  "are used as stored",
                  name, header.orientation),
      "orientation");
}

/// Returns whether a decoder's message tells of damaged pixels. A few extraneous bytes before a
/// marker are a habit of some cameras and damage nothing.
bool TellsOfDamage(const std::string& complaint) {
  constexpr int kMaxPadding = 4;
  int num_bytes = 0;
  const bool is_padding =
      std::sscanf(complaint.c_str(), "Corrupt JPEG data: %d extraneous bytes", &num_bytes) == 1;
  if (is_padding) return num_bytes > kMaxPadding;
  return complaint.starts_with("Corrupt JPEG data") ||
         complaint.starts_with("Premature end of JPEG") || complaint.starts_with("libpng error");
}

cv::Mat Decode(const std::string& bytes, int flags, std::string& complaint) {
  if (bytes.empty() || IsTruncatedJpeg(bytes) || IsTruncatedPng(bytes)) return {};
  const Codecs& codecs = GetCodecs();
  DecoderMessages messages;
  const cv::Mat image = codecs.DecodeImage(bytes, flags | cv::IMREAD_IGNORE_ORIENTATION);
  complaint = messages.Take();
  if (TellsOfDamage(complaint)) return {};
  return image;
}

/// Decodes an image file with the flags of cv::imread(); the orientation of EXIF is ignored.
cv::Mat DecodeImage(const std::string& bytes, int flags, const std::string& name) {
  const ImageHeader header = ParseImageHeader(bytes).value_or(ImageHeader());
  CheckHeader(header, name);
  std::string complaint;
  const cv::Mat image = Decode(bytes, flags, complaint);
  if (image.empty()) {
    throw Error(fmt::format("{}: not a readable image{}", name,
                            complaint.empty() ? "" : " (" + complaint + ")"));
  }
  WarnOfOrientation(header, name);
  if (!complaint.empty()) {
    LogOnce(spdlog::level::warn, fmt::format("{}: the decoder says: {}", name, complaint),
            complaint);
  }
  return image;
}

void CheckType(const cv::Mat& image, const std::string& name) {
  const int channels = image.channels();
  if (image.empty() || (image.depth() != CV_8U && image.depth() != CV_16U) ||
      (channels != 1 && channels != 3 && channels != 4)) {
    throw Error(
        fmt::format("{}: images of type {} are not supported, only 8 and 16 bits, gray or color",
                    name, cv::typeToString(image.type())));
  }
}

/// Converts color to gray of the same depth.
cv::Mat WithoutColor(const cv::Mat& image, const std::string& name) {
  CheckType(image, name);
  const int channels = image.channels();
  cv::Mat gray = image;
  if (channels > 1) {
    cv::cvtColor(image, gray, channels == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  }
  return gray;
}

}  // namespace

cv::Mat ToGray(const cv::Mat& image, const std::string& name) {
  return GrayLevels().ToByte(WithoutColor(image, name));
}

cv::Mat DecodeStoredGray(const std::string& bytes, const std::string& name) {
  return WithoutColor(DecodeImage(bytes, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH, name), name);
}

cv::Mat ReadStoredGray(const fs::path& file) {
  return DecodeStoredGray(ReadFileBytes(file, kMaxImageBytes), file.string());
}

cv::Mat ReadGrayImage(const fs::path& file, const GrayLevels& levels) {
  return levels.ToByte(ReadStoredGray(file));
}

cv::Mat ReadStoredColor(const fs::path& file) {
  const cv::Mat image = DecodeImage(ReadFileBytes(file, kMaxImageBytes),
                                    cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH, file.string());
  CheckType(image, file.string());
  return image;
}

cv::Mat ReadColorImage(const fs::path& file, const GrayLevels& levels) {
  return levels.ToByte(ReadStoredColor(file));
}

}  // namespace corvo
