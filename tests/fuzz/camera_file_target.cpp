// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/calibration_file.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/fuzz/targets.h"
#include "vo/io/config.h"

namespace corvo::fuzz {

void FuzzCameraFile(Bytes bytes) {
  const std::filesystem::path file = WriteScratchFile(Input(bytes).Text());
  AllowError([&] {
    const CalibrationFile stated = ReadCalibrationFile(file);
    const CameraFile read = stated.camera.ForImages(640, 480);
    Require(read.camera.parameters().IsValid(), "a camera that is read is valid");
    for (const std::string& name : stated.names) {
      AllowError([&] { ReadCalibrationFile(file, name); });
    }
    const CalibrationFile again = ReadCalibrationFile(WriteScratchFile(WriteCameraFile(read)));
    Require(again.camera.parameters == read.camera.parameters(),
            "a camera that is written is read back unchanged");
  });
}

}  // namespace corvo::fuzz
