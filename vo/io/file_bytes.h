// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace corvo {

inline constexpr std::size_t kMebibyte = 1 << 20;

/// The largest YAML or XML file that is read, such as a configuration, bytes.
inline constexpr std::size_t kMaxYamlBytes = 1 * kMebibyte;
/// The largest file of a camera in any other form that is read, bytes.
inline constexpr std::size_t kMaxCalibrationBytes = 16 * kMebibyte;
/// The largest text file that is read, such as a trajectory or a list of images, bytes.
inline constexpr std::size_t kMaxTextBytes = 256 * kMebibyte;
/// The largest encoded image that is read, bytes.
inline constexpr std::size_t kMaxImageBytes = 256 * kMebibyte;

/// The largest binary result file that is read, bytes.
inline constexpr std::size_t kMaxResultBytes = 8192 * kMebibyte;

/// Returns the content of a file, which may be a pipe. Never reads much more than `max_bytes`.
/// Throws corvo::Error if the file cannot be read, is a folder, or is larger than `max_bytes`.
std::string ReadFileBytes(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace corvo
