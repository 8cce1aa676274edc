// SPDX-License-Identifier: MIT
#include "apps/run/image_names.h"

#include <algorithm>

namespace corvo {
namespace {

namespace fs = std::filesystem;

fs::path Absolute(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

/// Returns the folder at which the paths of all files begin.
fs::path CommonFolder(const std::vector<TimedFile>& files) {
  fs::path common = Absolute(files.front().file).parent_path();
  for (const TimedFile& file : files) {
    const fs::path folder = Absolute(file.file).parent_path();
    const auto [end, ignored] =
        std::mismatch(common.begin(), common.end(), folder.begin(), folder.end());
    fs::path shared;
    for (auto part = common.begin(); part != end; ++part) shared /= *part;
    common = shared;
  }
  return common;
}

}  // namespace

ImageNames::ImageNames(const fs::path& input, const ImageList& list) {
  if (list.layout == "video" || list.layout == "bag") video_ = Absolute(input);
  if (list.images.empty()) return;
  folder_ = fs::is_directory(input) ? Absolute(input) : CommonFolder(list.images);
}

std::string ImageNames::Of(const TimedImage& image) const {
  if (folder_.empty()) return std::to_string(image.index);
  return Absolute(image.name).lexically_relative(folder_).generic_string();
}

}  // namespace corvo
