// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

namespace corvo {

/// The extensions of the image formats that are read, in lower case; upper case counts as well.
inline constexpr std::array<std::string_view, 12> kImageExtensions = {
    "png", "jpg", "jpeg", "jpe", "bmp", "pgm", "ppm", "pnm", "tif", "tiff", "webp", "jp2"};

/// Returns whether a file has one of kImageExtensions.
bool HasImageExtension(const std::filesystem::path& file);

/// Returns the image files of a folder, in natural order, without hidden ones and those that corvo
/// wrote.
std::vector<std::filesystem::path> ImageFilesIn(const std::filesystem::path& folder);

/// Removes the files that corvo wrote: output never becomes input.
void RemoveOutput(std::vector<std::filesystem::path>& files);

/// Sorts paths in natural order of their file names.
void SortByName(std::vector<std::filesystem::path>& paths);

/// Returns the absolute, normalized path of a folder, without a separator at its end.
std::filesystem::path AbsoluteFolder(const std::filesystem::path& folder);

/// Returns whether `a` precedes `b` in natural order, in which runs of digits are compared as
/// numbers: "2.png" precedes "10.png".
bool NaturalLess(std::string_view a, std::string_view b);

}  // namespace corvo
