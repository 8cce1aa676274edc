// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vo/core/conventions.h"

namespace corvo {

/// Returns the times in the names of image files, such as 1403636579763555584.png (ns) or
/// 1305031102.175304.png (s), or std::nullopt if not every name, without its extension, is a time
/// between the years 2000 and 2100, in ascending order.
std::optional<std::vector<TimeNs>> TimesInNames(const std::vector<std::filesystem::path>& files);

/// Reads the times of image files, one row per image: the time alone, or in the columns "time name"
/// or "name time", with or without extension and in the order of the images. The unit follows from
/// the magnitude of the first time, see GuessTimeUnit(). Throws corvo::Error with file and line if
/// a row is malformed, names another image, or if the number of rows is not that of the images.
std::vector<TimeNs> ReadImageTimes(const std::filesystem::path& file,
                                   const std::vector<std::filesystem::path>& images);

}  // namespace corvo
