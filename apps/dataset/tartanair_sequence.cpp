// SPDX-License-Identifier: MIT
#include "apps/dataset/image_layouts.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLeftFolder = "image_left";

}  // namespace

bool IsTartanAirSequence(const fs::path& input) {
  return fs::is_directory(input / kLeftFolder) && fs::exists(input / kTartanAirPoses);
}

ImageList ListTartanAirImages(const fs::path& input, const InputOptions& options) {
  ImageList list{"tartanair", {}, {}};
  AddIndexTimes(ImageFilesIn(input / kLeftFolder), options, list);
  // The same pinhole camera in every sequence (Wang et al., TartanAir, IROS 2020).
  CameraParameters camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 320;
  camera.cx = 320;
  camera.cy = 240;
  list.camera = camera;
  return list;
}

}  // namespace corvo
