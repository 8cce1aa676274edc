// SPDX-License-Identifier: MIT
#pragma once

#include "apps/codecs/codecs.h"

namespace corvo {

/// Returns the codecs of OpenCV's modules imgcodecs and videoio.
const Codecs& OpenCvCodecs();

}  // namespace corvo
