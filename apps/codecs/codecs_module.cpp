// SPDX-License-Identifier: MIT
// The entry of the module that the command loads when it needs codecs.
#include "apps/codecs/opencv_codecs.h"

extern "C" __attribute__((visibility("default"))) const corvo::Codecs* corvo_codecs() {
  return &corvo::OpenCvCodecs();
}
