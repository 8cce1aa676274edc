// SPDX-License-Identifier: MIT
#include "apps/dataset/image_header.h"

#include <algorithm>
#include <charconv>
#include <cstddef>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

using Bytes = std::string_view;

/// Returns an unsigned number of `size` bytes; bytes behind the end are 0.
std::uint32_t NumberAt(Bytes bytes, std::size_t at, int size, bool is_big_endian) {
  std::uint32_t number = 0;
  for (int i = 0; i < size; ++i) {
    const std::size_t from = at + (is_big_endian ? i : size - 1 - i);
    const std::uint8_t byte = from < bytes.size() ? static_cast<std::uint8_t>(bytes[from]) : 0;
    number = number << 8 | byte;
  }
  return number;
}

std::uint32_t Big(Bytes bytes, std::size_t at, int size) { return NumberAt(bytes, at, size, true); }

std::uint32_t Little(Bytes bytes, std::size_t at, int size) {
  return NumberAt(bytes, at, size, false);
}

/// Returns the bytes from `begin` on; empty behind the end.
Bytes From(Bytes bytes, std::size_t begin) { return bytes.substr(std::min(begin, bytes.size())); }

/// Parses the first directory of a TIFF file, in which EXIF is stored, too.
ImageHeader ParseTiff(Bytes bytes) {
  constexpr int kWidthTag = 256, kHeightTag = 257, kOrientationTag = 274, kShortType = 3;
  const bool is_big_endian = bytes.starts_with("MM");
  const auto number = [&](std::size_t at, int size) {
    return NumberAt(bytes, at, size, is_big_endian);
  };
  const std::size_t directory = number(4, 4);
  ImageHeader header;
  for (std::size_t i = 0; i < number(directory, 2); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (entry >= bytes.size()) break;
    const std::uint32_t value = number(entry + 8, number(entry + 2, 2) == kShortType ? 2 : 4);
    switch (number(entry, 2)) {
      case kWidthTag:
        header.width = value;
        break;
      case kHeightTag:
        header.height = value;
        break;
      case kOrientationTag:
        header.orientation = static_cast<int>(value);
        break;
      default:
        break;
    }
  }
  return header;
}

int OrientationOf(Bytes exif) {
  if (!exif.starts_with("MM") && !exif.starts_with("II")) return 1;
  const int orientation = ParseTiff(exif).orientation;
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

/// Returns whether a marker of JPEG starts a frame, which has the size: SOF0 to SOF15, except the
/// tables with numbers among them.
bool IsFrameMarker(std::uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

ImageHeader ParseJpeg(Bytes bytes) {
  constexpr Bytes kExif("Exif\0\0", 6);
  ImageHeader header;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    const std::uint32_t marker = Big(bytes, at + 1, 1);
    if (Big(bytes, at, 1) != 0xff || marker == 0xff) {  // Fill bytes precede a marker.
      ++at;
      continue;
    }
    if (IsFrameMarker(marker)) {
      header.height = Big(bytes, at + 5, 2);
      header.width = Big(bytes, at + 7, 2);
      break;
    }
    const bool is_exif = marker == 0xe1 && From(bytes, at + 4).starts_with(kExif);
    if (is_exif) header.orientation = OrientationOf(From(bytes, at + 4 + kExif.size()));
    const bool has_length = marker != 0x01 && (marker < 0xd0 || marker > 0xd8);
    at += 2 + (has_length ? Big(bytes, at + 2, 2) : 0);
  }
  return header;
}

ImageHeader ParsePng(Bytes bytes) {
  ImageHeader header{Big(bytes, 16, 4), Big(bytes, 20, 4), 1};
  for (std::size_t at = 8; at + 8 <= bytes.size(); at += 12 + std::size_t{Big(bytes, at, 4)}) {
    const Bytes type = bytes.substr(at + 4, 4);
    if (type == "eXIf") header.orientation = OrientationOf(From(bytes, at + 8));
  }
  return header;
}

ImageHeader ParseBmp(Bytes bytes) {
  const bool is_old = Little(bytes, 14, 4) == 12;
  if (is_old) return {Little(bytes, 18, 2), Little(bytes, 20, 2), 1};
  const std::int64_t height = static_cast<std::int32_t>(Little(bytes, 22, 4));
  return {Little(bytes, 18, 4), height < 0 ? -height : height, 1};
}

/// Parses "P5 width height ...", with `#` comments.
ImageHeader ParsePnm(Bytes bytes) {
  std::int64_t size[2] = {0, 0};
  bytes.remove_prefix(2);
  for (std::int64_t& number : size) {
    for (;;) {
      bytes = From(bytes, bytes.find_first_not_of(" \t\r\n"));
      if (!bytes.starts_with('#')) break;
      bytes = From(bytes, bytes.find('\n'));
    }
    const auto [end, error] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), number);
    if (error != std::errc()) return {};
    bytes.remove_prefix(static_cast<std::size_t>(end - bytes.data()));
  }
  constexpr std::int64_t kMaxSide = 1 << 30;
  return {std::clamp<std::int64_t>(size[0], 0, kMaxSide),
          std::clamp<std::int64_t>(size[1], 0, kMaxSide), 1};
}

ImageHeader ParseWebp(Bytes bytes) {
  ImageHeader header;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const Bytes type = bytes.substr(at, 4);
    const std::size_t data = at + 8;
    if (type == "VP8X") {
      header.width = 1 + std::int64_t{Little(bytes, data + 4, 3)};
      header.height = 1 + std::int64_t{Little(bytes, data + 7, 3)};
    } else if (type == "VP8 " && header.width == 0) {
      header.width = Little(bytes, data + 6, 2) & 0x3fff;
      header.height = Little(bytes, data + 8, 2) & 0x3fff;
    } else if (type == "VP8L" && header.width == 0) {
      const std::uint32_t bits = Little(bytes, data + 1, 4);
      header.width = 1 + std::int64_t{bits & 0x3fff};
      header.height = 1 + std::int64_t{bits >> 14 & 0x3fff};
    } else if (type == "EXIF") {
      header.orientation = OrientationOf(From(bytes, data));
    }
    const std::size_t size = Little(bytes, at + 4, 4);
    at = data + size + size % 2;
  }
  return header;
}

ImageHeader Parse(Bytes bytes) {
  if (bytes.starts_with("\x89PNG")) return ParsePng(bytes);
  if (bytes.starts_with("\xFF\xD8")) return ParseJpeg(bytes);
  if (bytes.starts_with("BM")) return ParseBmp(bytes);
  if (bytes.starts_with("MM") || bytes.starts_with("II")) return ParseTiff(bytes);
  if (bytes.starts_with("RIFF") && From(bytes, 8).starts_with("WEBP")) return ParseWebp(bytes);
  const bool is_pnm = bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6';
  return is_pnm ? ParsePnm(bytes) : ImageHeader();
}

}  // namespace

std::optional<ImageHeader> ParseImageHeader(std::string_view bytes) {
  const ImageHeader header = Parse(bytes);
  if (header.width <= 0 || header.height <= 0) return std::nullopt;
  return header;
}

ImageHeader ReadImageHeader(const std::filesystem::path& file) {
  const auto header = ParseImageHeader(ReadFileBytes(file, kMaxImageBytes));
  if (!header) {
    throw Error(fmt::format("{}: no header of a png, jpg, bmp, pnm, tif or webp image was found",
                            file.string()));
  }
  CheckRange(file.string() + ": number of pixels", header->num_pixels(), std::int64_t{1},
             kMaxImagePixels);
  return *header;
}

}  // namespace corvo
