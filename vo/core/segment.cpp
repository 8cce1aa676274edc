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
    case ScaleSource::kKnownSize:
      return "known_size";
  }
  return "unknown";
}

bool IsMetric(ScaleSource source) {
  return source != ScaleSource::kArbitrary && source != ScaleSource::kMedianSpeed;
}

}  // namespace corvo
