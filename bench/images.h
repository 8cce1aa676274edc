// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace corvo::bench {

/// Gray images of one size, created at their first use and then kept.
class ImageSet {
 public:
  using Maker = std::function<std::vector<cv::Mat>(int count)>;

  /// `read` reads the images from `folder` of the test data; if that is missing, `render` renders
  /// them.
  ImageSet(std::string name, int count, std::string folder, Maker read, Maker render);

  const std::string& name() const { return name_; }
  int count() const { return count_; }

  /// Returns the folder of the test data, or "synthetic".
  std::string Source() const;

  /// Returns the images, always the same vector. Throws corvo::Error if an image cannot be read.
  const std::vector<cv::Mat>& Images();

 private:
  bool FolderExists() const;

  std::string name_;
  int count_;
  std::string folder_;
  Maker read_;
  Maker render_;
  std::vector<cv::Mat> images_;
};

/// The image sizes that are measured.
struct ImageSets {
  ImageSet vga;      ///< 640x480: 7-Scenes, hand-held.
  ImageSet kitti;    ///< 1242x375: KITTI 03, a drive.
  ImageSet euroc;    ///< 752x480: EuRoC MH_01, a drone.
  ImageSet full_hd;  ///< 1920x1080: mosaics of Oxford's images at their own resolution.
};

/// Returns up to `max_count` images of each size, spread over the sequences.
ImageSets MakeImageSets(int max_count);

}  // namespace corvo::bench
