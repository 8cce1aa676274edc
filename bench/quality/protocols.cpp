// SPDX-License-Identifier: MIT
#include "bench/quality/protocols.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "orb/error.h"
#include "tests/data/data_path.h"

namespace corvo::bench {
namespace {

constexpr std::uint64_t kSeed = 1;

cv::Mat ReadGray(const std::filesystem::path& file) {
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw Error(file.string() + ": no image that can be read");
  return image;
}

/// Reads image `number` (from 1) of a sequence: a .ppm or, if gray, a .pgm.
cv::Mat ReadOxford(const std::string& name, int number) {
  const auto file = test::DataPath(fmt::format("oxford_affine/{}/img{}", name, number)).string();
  return ReadGray(std::filesystem::exists(file + ".ppm") ? file + ".ppm" : file + ".pgm");
}

using Change = View (*)(const cv::Mat&, double);

void AppendSeries(const std::string& series, Change change, const std::vector<double>& parameters,
                  const std::vector<Image>& images, std::vector<PairTask>& tasks) {
  for (const Image& image : images) {
    for (const double parameter : parameters) {
      tasks.push_back({series, image.name, parameter, false, image.image,
                       [=] { return change(image.image, parameter); }});
    }
  }
}

View RotateNoisily(const cv::Mat& image, double angle_deg, double sigma) {
  View view = Rotate(image, angle_deg);
  view.image = AddNoise(view.image, sigma, kSeed);
  return view;
}

View CompressWhole(const cv::Mat& image, double quality) {
  return CompressJpeg(image, static_cast<int>(quality));
}

}  // namespace

std::vector<PairTask> RotationTasks(const std::vector<Image>& images) {
  std::vector<PairTask> tasks;
  for (const int sigma : {0, 10, 20}) {
    for (const Image& image : images) {
      for (int angle = 0; angle < 360; angle += 10) {
        tasks.push_back({fmt::format("rotation, sigma {}", sigma), image.name,
                         static_cast<double>(angle), true, image.image,
                         [=] { return RotateNoisily(image.image, angle, sigma); }});
      }
    }
  }
  return tasks;
}

std::vector<PairTask> ChangeTasks(const std::vector<Image>& images) {
  std::vector<PairTask> tasks;
  AppendSeries("scale", Scale, {0.5, 0.6, 0.7, 0.8, 0.9, 1.1, 1.25, 1.4, 1.6, 1.8, 2}, images,
               tasks);
  AppendSeries("blur", Blur, {0.5, 1, 1.5, 2, 3, 4, 5}, images, tasks);
  AppendSeries("jpeg", CompressWhole, {90, 70, 50, 30, 20, 10, 5}, images, tasks);
  AppendSeries("brightness", AddBrightness, {-90, -60, -30, 30, 60, 90}, images, tasks);
  AppendSeries("contrast", ChangeContrast, {0.25, 0.5, 0.75, 1.5, 2, 3}, images, tasks);
  return tasks;
}

std::vector<PairTask> OxfordTasks(const std::vector<std::string>& names) {
  std::vector<PairTask> tasks;
  for (const std::string& name : names) {
    const cv::Mat first = ReadOxford(name, 1);
    for (int i = 2; i <= 6; ++i) {
      const auto homography = test::DataPath(fmt::format("oxford_affine/{}/H1to{}p", name, i));
      View second = {ReadOxford(name, i), ReadHomography(homography.string())};
      tasks.push_back({"oxford " + name, name, static_cast<double>(i), false, first,
                       [second = std::move(second)] { return second; }});
    }
  }
  return tasks;
}

std::vector<Image> ReadImages() {
  std::vector<Image> images;
  for (const std::string name : {"graf", "boat", "bikes"}) {
    images.push_back({name, ReadOxford(name, 1)});
  }
  images.push_back(
      {"7scenes", ReadGray(test::DataPath("7scenes/redkitchen/frame-000000.color.jpg"))});
  return images;
}

}  // namespace corvo::bench
