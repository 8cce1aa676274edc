// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace corvo {

/// The largest number of pixels of an image that is decoded or made by resizing.
inline constexpr std::int64_t kMaxImagePixels = 100'000'000;

/// What the first bytes of an encoded image say about it.
struct ImageHeader {
  std::int64_t width = 0, height = 0;  ///< px
  /// The orientation of EXIF, 1 to 8; 1 (upright) if there is none.
  int orientation = 1;

  std::int64_t num_pixels() const { return width * height; }
};

/// Parses the header of a PNG, JPEG, BMP, PNM, TIFF or WebP image without decoding it. Returns
/// std::nullopt for any other format and if the size is not found.
std::optional<ImageHeader> ParseImageHeader(std::string_view bytes);

/// Parses the header of an image file. Throws corvo::Error if the file cannot be read, is none of
/// these formats, or is larger than kMaxImagePixels.
ImageHeader ReadImageHeader(const std::filesystem::path& file);

}  // namespace corvo
