// SPDX-License-Identifier: MIT
#pragma once

namespace corvo {

/// Returns by how much images are to be turned clockwise, given what a version of OpenCV says of
/// their orientation: 4.6 counts counterclockwise (issue 22088 of OpenCV), earlier and later ones
/// clockwise.
constexpr int ClockwiseDegrees(int said_deg, int major, int minor) {
  return major == 4 && minor == 6 ? (360 - said_deg) % 360 : said_deg;
}

}  // namespace corvo
