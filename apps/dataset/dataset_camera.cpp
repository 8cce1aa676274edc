// SPDX-License-Identifier: MIT
#include "apps/dataset/dataset_camera.h"

#include "apps/dataset/camera_formats/calibration_file.h"
#include "apps/dataset/image_header.h"

namespace corvo {

CameraParameters ReadDatasetCamera(const std::filesystem::path& file, const std::string& name,
                                   const std::filesystem::path& first_image) {
  const StatedCamera stated = ReadCalibrationFile(file, name).camera;
  if (stated.has_size()) return stated.parameters;
  const ImageHeader image = ReadImageHeader(first_image);
  return stated.ForImages(static_cast<int>(image.width), static_cast<int>(image.height))
      .camera.parameters();
}

}  // namespace corvo
