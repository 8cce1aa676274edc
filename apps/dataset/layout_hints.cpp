// SPDX-License-Identifier: MIT
#include "apps/dataset/layout_hints.h"

#include <array>

#include <fmt/format.h>

namespace corvo {
namespace {

/// A file or folder that belongs to a layout, and what else the layout needs.
struct Hint {
  const char* present;
  const char* needed;
};

constexpr std::array<Hint, 8> kHints = {
    {{"calib.txt", "a KITTI sequence needs image_0 or image_2"},
     {"times.txt", "a KITTI sequence needs image_0 or image_2, a TUM-mono sequence images"},
     {"image_00", "a KITTI raw drive needs image_00/data and image_00/timestamps.txt"},
     {"oxts", "a KITTI raw drive needs image_00/data and image_00/timestamps.txt"},
     {"mav0", "a EuRoC sequence needs mav0/cam0/data and mav0/cam0/data.csv"},
     {"cam0", "a EuRoC sequence needs cam0/data and cam0/data.csv"},
     {"depth.txt", "a TUM RGB-D sequence needs rgb.txt or associations.txt"},
     {"pose_left.txt", "a TartanAir sequence needs image_left"}}};

}  // namespace

std::string LayoutHints(const std::filesystem::path& folder) {
  std::string text;
  for (const Hint& hint : kHints) {
    if (!std::filesystem::exists(folder / hint.present)) continue;
    text += fmt::format("; it has {}, but {}", hint.present, hint.needed);
  }
  return text;
}

}  // namespace corvo
