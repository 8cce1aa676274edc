// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "apps/dataset/image_source.h"

namespace corvo {

/// The names by which the results refer to the images of a run: those of files relative to one
/// folder, and the positions of frames in a video or bag, from 0.
class ImageNames {
 public:
  ImageNames(const std::filesystem::path& input, const ImageList& list);

  /// Returns the absolute folder of the images; empty for a video, a bag or a camera.
  const std::filesystem::path& folder() const { return folder_; }
  /// Returns the absolute path of the video or bag; empty for image files and cameras.
  const std::filesystem::path& video() const { return video_; }

  std::string Of(const TimedImage& image) const;

 private:
  std::filesystem::path folder_, video_;
};

}  // namespace corvo
