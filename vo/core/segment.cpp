// SPDX-License-Identifier: MIT
#include "vo/core/segment.h"

namespace corvo {

std::string_view ToString(ScaleSource source) {
  switch (source) {
    case ScaleSource::kArbitrary:
      return "arbitrary";
    case ScaleSource::kMedianSpeed:
      return "median_speed";
    case ScaleSource::kCameraHeight:
      return "camera_height";
    case ScaleSource::kKnownDistance:
      return "known_distance";
  }
  return "unknown";
}

}  // namespace corvo
