// SPDX-License-Identifier: MIT
#include "apps/run/stated_focal.h"

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/camera/centered_pinhole.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

bool IsNumber(const std::string& text) {
  try {
    ParseNumber(text, "");
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

void CheckFocalText(const std::string& text) {
  if (text == kAutoFocal || IsNumber(text)) return;
  throw Error(
      fmt::format("--focal is \"{}\"; allowed is auto, or a focal length in px (for a field of "
                  "view in degrees, give --fov)",
                  text));
}

std::optional<double> StatedFocal(const std::string& focal, std::optional<double> fov_deg,
                                  int width) {
  if (fov_deg) return FocalOfFov(*fov_deg, width);
  if (focal.empty() || focal == kAutoFocal) return std::nullopt;
  const double focal_px = ParseNumber(focal, "--focal ");
  const double shortest = FocalOfFov(kMaxStatedFovDeg, width);
  const double longest = FocalOfFov(kMinStatedFovDeg, width);
  if (focal_px >= shortest && focal_px <= longest) return focal_px;
  throw Error(
      fmt::format("--focal is {}; allowed is {:.1f} to {:.1f} px for images of {} px of width "
                  "(fields of view of {} to {} degrees)",
                  focal, shortest, longest, width, kMaxStatedFovDeg, kMinStatedFovDeg));
}

}  // namespace corvo
