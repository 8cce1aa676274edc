// SPDX-License-Identifier: MIT
#include "tests/fuzz/scratch_folder.h"
#include "tests/fuzz/targets.h"
#include "vo/io/config.h"

namespace corvo::fuzz {

void FuzzCameraFile(Bytes bytes) {
  const std::filesystem::path file = WriteScratchFile(Input(bytes).Text());
  AllowError([&] {
    const CameraFile read = ReadCameraFile(file);
    Require(read.camera.parameters().IsValid(), "a camera that is read is valid");
    const CameraFile again = ReadCameraFile(WriteScratchFile(WriteCameraFile(read)));
    Require(again.camera == read.camera, "a camera that is written is read back unchanged");
  });
}

}  // namespace corvo::fuzz
