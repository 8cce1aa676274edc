// SPDX-License-Identifier: MIT
#include "apps/dataset/dataset_camera.h"

#include "apps/dataset/camera_formats/calibration_file.h"
#include "apps/dataset/image_reader.h"

namespace corvo {

CameraParameters ReadDatasetCamera(const std::filesystem::path& file, const std::string& name,
                                   const std::filesystem::path& first_image) {
  const StatedCamera stated = ReadCalibrationFile(file, name).camera;
  if (stated.has_size()) return stated.parameters;
  const cv::Mat image = ReadGrayImage(first_image);
  return stated.ForImages(image.cols, image.rows).camera.parameters();
}

}  // namespace corvo
