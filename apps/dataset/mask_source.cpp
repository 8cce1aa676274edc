// SPDX-License-Identifier: MIT
#include "apps/dataset/mask_source.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/dataset/image_layouts.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

auto FindNamed(const std::vector<fs::path>& files, const TimedImage& image) {
  const fs::path stem = fs::path(image.name).stem();
  return std::find_if(files.begin(), files.end(),
                      [&stem](const fs::path& file) { return file.stem() == stem; });
}

}  // namespace

MaskSource::MaskSource(const fs::path& path, const TimedImage& first) : path_(path) {
  if (!fs::is_directory(path)) {
    only_ = ReadGrayImage(path);
    return;
  }
  files_ = ImageFilesIn(path);
  if (files_.empty()) throw Error(fmt::format("{}: contains no masks", path.string()));
  by_name_ = FindNamed(files_, first) != files_.end();
}

cv::Mat MaskSource::MaskOf(const TimedImage& image) const {
  if (path_.empty()) return {};
  cv::Mat mask = only_.empty() ? ReadGrayImage(FileOf(image)) : only_;
  if (mask.size() == image.image.size()) return mask;
  throw Error(fmt::format("{}: the mask is {} x {} px, the image {} {} x {} px",
                          (only_.empty() ? FileOf(image) : path_).string(), mask.cols, mask.rows,
                          image.name, image.image.cols, image.image.rows));
}

const fs::path& MaskSource::FileOf(const TimedImage& image) const {
  if (by_name_) {
    const auto named = FindNamed(files_, image);
    if (named != files_.end()) return *named;
  } else if (image.index < static_cast<int>(files_.size())) {
    return files_[image.index];
  }
  throw Error(fmt::format("{}: contains no mask for {}", path_.string(), image.name));
}

}  // namespace corvo
