// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "apps/dataset/image_source.h"
#include "vo/offline/image_stream.h"

namespace corvo {

/// Opens a sequence for the library, prepared so that each image has the same size. A mask source
/// is that of the images as `open` hands them out.
StreamOpener ToStreamOpener(std::function<ImageSource()> open);

}  // namespace corvo
