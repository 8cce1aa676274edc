// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/tracking/cell_displacement.h"

namespace corvo {

/// Finds images that show the same as an earlier one, from the same pose, up to the noise of a
/// sensor or a codec: frames that a camera driver or a conversion of the frame rate has repeated,
/// and those of a camera that stands still.
class RepeatDetector {
 public:
  /// Returns whether `image` repeats the last one that did not repeat another: of its textured
  /// cells seven in ten have moved by less than 0.3 px, and the median cell has neither shifted nor
  /// expanded nor turned by 0.1 px. An image with hardly any texture repeats another one only if
  /// the two are equal. All images have the same size.
  bool Add(const ReducedImage& image);

 private:
  std::optional<CellDisplacement> reference_;
};

}  // namespace corvo
