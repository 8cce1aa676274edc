// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "apps/dataset/image_source.h"
#include "vo/offline/image_stream.h"

namespace corvo {

/// Returns an opener of the library's image streams that read the images and masks of the sources
/// returned by `open`, which should prepare them so that all images have the same size.
StreamOpener ToStreamOpener(std::function<ImageSource()> open);

}  // namespace corvo
