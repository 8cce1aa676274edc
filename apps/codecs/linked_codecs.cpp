// SPDX-License-Identifier: MIT
#include "apps/codecs/opencv_codecs.h"

namespace corvo {

const Codecs& GetCodecs() { return OpenCvCodecs(); }

}  // namespace corvo
