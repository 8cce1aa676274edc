// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/data/temporary_folder.h"

namespace corvo::test {

inline constexpr int kTinyWidth = 96;
inline constexpr int kTinyHeight = 64;

/// Returns a gray image with a seeded random texture.
inline cv::Mat TinyImage(int seed, int width = kTinyWidth, int height = kTinyHeight) {
  cv::Mat image(height, width, CV_8UC1);
  cv::RNG rng(static_cast<std::uint64_t>(seed) + 1);
  rng.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

/// Like TinyImage(), but smoothed and of full contrast, so that its corners are also detected in
/// other views.
inline cv::Mat SmoothImage(int seed, int width, int height) {
  cv::Mat image = TinyImage(seed, width, height);
  cv::GaussianBlur(image, image, cv::Size(), 3, 3);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

inline void WriteImage(const std::filesystem::path& file, const cv::Mat& image) {
  std::filesystem::create_directories(file.parent_path());
  ASSERT_TRUE(cv::imwrite(file.string(), image)) << file;
}

/// Writes images 0.png, 1.png, ...
inline void WriteFolder(const std::filesystem::path& folder, int count) {
  for (int i = 0; i < count; ++i) WriteImage(folder / (std::to_string(i) + ".png"), TinyImage(i));
}

/// Writes a KITTI odometry sequence at 10 Hz with fx 80, fy 81, cx 47.5, cy 31.5.
inline void WriteKitti(const std::filesystem::path& folder, int count) {
  std::string times;
  for (int i = 0; i < count; ++i) {
    WriteImage(folder / "image_0" / ("00000" + std::to_string(i) + ".png"), TinyImage(i));
    times += std::to_string(i) + ".000000e-01\n";
  }
  WriteText(folder / "times.txt", times);
  WriteText(folder / "calib.txt",
            "P0: 80 0 47.5 0 0 81 31.5 0 0 0 1 0\nP1: 80 0 47.5 -9 0 81 31.5 0 0 0 1 0\n");
}

/// Returns a sensor.yaml like the dataset's, with the size of the tiny images.
inline std::string EurocSensor() {
  return "%YAML:1.0\n# General sensor definitions.\nsensor_type: camera\n"
         "T_BS:\n  cols: 4\n  rows: 4\n  data: [1.0, 0.0, 0.0, 0.0,\n"
         "         0.0, 1.0, 0.0, 0.0,\n        0.0, 0.0, 1.0, 0.0,\n         0.0, 0.0, 0.0, 1.0]\n"
         "rate_hz: 20\nresolution: [96, 64]\ncamera_model: pinhole\n"
         "intrinsics: [80.5, 81.5, 47.25, 31.25] #fu, fv, cu, cv\n"
         "distortion_model: radial-tangential\n"
         "distortion_coefficients: [-0.28, 0.07, 0.0002, 1.76e-05]\n";
}

/// Writes a EuRoC `mav0` folder at 20 Hz, with Windows line ends as in the dataset.
inline void WriteEuroc(const std::filesystem::path& mav0, int count) {
  std::string table = "#timestamp [ns],filename\r\n";
  for (int i = 0; i < count; ++i) {
    const std::string time_ns = std::to_string(1403636579763555584 + 50000000LL * i);
    WriteImage(mav0 / "cam0" / "data" / (time_ns + ".png"), TinyImage(i));
    table.append(time_ns).append(",").append(time_ns).append(".png\r\n");
  }
  WriteText(mav0 / "cam0" / "data.csv", table);
  WriteText(mav0 / "cam0" / "sensor.yaml", EurocSensor());
}

/// Writes a TUM RGB-D sequence at 25 Hz, in color.
inline void WriteTum(const std::filesystem::path& folder, int count) {
  std::string table = "# color images\n# timestamp filename\n";
  for (int i = 0; i < count; ++i) {
    cv::Mat gray = TinyImage(i);
    cv::Mat color;
    cv::merge(std::vector<cv::Mat>{gray, gray, gray}, color);
    const std::string time = std::to_string(1305031102175304 + 40000 * i);
    const std::string name = "rgb/" + time.substr(0, 10) + "." + time.substr(10) + ".png";
    WriteImage(folder / name, color);
    table += time.substr(0, 10) + "." + time.substr(10) + " " + name + "\n";
  }
  WriteText(folder / "rgb.txt", table);
}

}  // namespace corvo::test
