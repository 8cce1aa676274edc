// SPDX-License-Identifier: MIT
#include "bench/images.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/synthetic/sequence.h"
#include "orb/error.h"
#include "tests/data/data_path.h"

namespace corvo::bench {
namespace {

constexpr int kMosaics = 24;  ///< Maximum number: one starts at each of Oxford's images.
const cv::Size kFullHd(1920, 1080);

cv::Mat ReadGray(const std::string& file) {
  cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw Error(file + ": no image that can be read");
  return image;
}

/// Returns the files of the test data that match a pattern of cv::glob, sorted by name.
std::vector<std::string> FindFiles(const std::string& pattern, bool in_subfolders) {
  std::vector<cv::String> files;
  cv::glob(test::DataPath(pattern).string(), files, in_subfolders);
  if (files.empty()) throw Error(test::DataPath(pattern).string() + ": no such files");
  return files;
}

/// Returns a function that reads images spread evenly over the files that match.
ImageSet::Maker ReadSpread(const std::string& pattern) {
  return [pattern](int count) {
    const std::vector<std::string> files = FindFiles(pattern, false);
    std::vector<cv::Mat> images;
    for (int i = 0; i < count; ++i) images.push_back(ReadGray(files[i * files.size() / count]));
    return images;
  };
}

/// Returns a mosaic of rows of images, cropped to `height`. The index advances by seven from one
/// image to the next, so that neighbors show different scenes.
cv::Mat Mosaic(const std::vector<cv::Mat>& images, int height, std::size_t first) {
  cv::Mat mosaic(kFullHd, CV_8UC1);
  const cv::Rect whole({0, 0}, kFullHd);
  std::size_t next = first;
  for (int y = 0; y < kFullHd.height; y += height) {
    for (int x = 0; x < kFullHd.width;) {
      const cv::Mat& image = images[next % images.size()];
      const cv::Rect tile = cv::Rect(x, y, image.cols, height) & whole;
      image(cv::Rect({0, 0}, tile.size())).copyTo(mosaic(tile));
      x += image.cols;
      next += 7;
    }
  }
  return mosaic;
}

std::vector<cv::Mat> MakeMosaics(int count) {
  std::vector<cv::Mat> images;
  for (const auto& file : FindFiles("oxford_affine/img*.p?m", true)) {
    images.push_back(ReadGray(file));
  }
  int height = images.front().rows;
  for (const cv::Mat& image : images) height = std::min(height, image.rows);
  std::vector<cv::Mat> mosaics;
  for (int i = 0; i < count; ++i) {
    mosaics.push_back(Mosaic(images, height, i * images.size() / count));
  }
  return mosaics;
}

/// Renders images spread evenly over a sequence.
std::vector<cv::Mat> RenderSpread(const synthetic::Sequence& sequence, int count) {
  std::vector<cv::Mat> images;
  for (int i = 0; i < count; ++i) images.push_back(sequence.Render(i * sequence.size() / count));
  return images;
}

/// Returns a function that renders images of the synthetic room.
ImageSet::Maker RenderRoom(cv::Size size) {
  return [size](int count) {
    synthetic::SequenceOptions options;
    options.camera.emplace();
    options.camera->width = size.width;
    options.camera->height = size.height;
    options.camera->fx = options.camera->fy = 0.8 * size.width;
    options.camera->cx = 0.5 * (size.width - 1);
    options.camera->cy = 0.5 * (size.height - 1);
    return RenderSpread(synthetic::MakeRoom(options), count);
  };
}

std::vector<cv::Mat> RenderStreet(int count) {
  return RenderSpread(synthetic::MakeStreet(), count);
}

}  // namespace

ImageSet::ImageSet(std::string name, int count, std::string folder, Maker read, Maker render)
    : name_(std::move(name)),
      count_(count),
      folder_(std::move(folder)),
      read_(std::move(read)),
      render_(std::move(render)) {}

bool ImageSet::FolderExists() const { return std::filesystem::exists(test::DataPath(folder_)); }

std::string ImageSet::Source() const { return FolderExists() ? folder_ : "synthetic"; }

const std::vector<cv::Mat>& ImageSet::Images() {
  if (images_.empty()) images_ = FolderExists() ? read_(count_) : render_(count_);
  return images_;
}

ImageSets MakeImageSets(int max_count) {
  const std::string vga = "7scenes/redkitchen";
  const std::string kitti = "kitti/sequences/03";
  const std::string euroc = "euroc/MH_01_easy";
  return {
      {"VGA", max_count, vga, ReadSpread(vga + "/*.jpg"), RenderRoom({640, 480})},
      {"KITTI", max_count, kitti, ReadSpread(kitti + "/image_0/*.png"), RenderStreet},
      {"EuRoC", max_count, euroc, ReadSpread(euroc + "/mav0/cam0/data/*.png"),
       RenderRoom({752, 480})},
      {"1920x1080", std::min(max_count, kMosaics), "oxford_affine", MakeMosaics,
       RenderRoom(kFullHd)},
  };
}

}  // namespace corvo::bench
