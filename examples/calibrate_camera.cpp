// SPDX-License-Identifier: MIT
// Estimates the camera of images without a calibration target:
// calibrate_camera CAMERA.yaml IMAGE...
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <corvo/vo/io/config.h>
#include <corvo/vo/offline/self_calibration.h>
#include <opencv2/imgcodecs.hpp>

namespace {

/// A stream of image files in the given order, at 30 Hz.
class ImageFiles final : public corvo::ImageStream {
 public:
  explicit ImageFiles(std::vector<std::string> files) : files_(std::move(files)) {}

  std::optional<corvo::StreamImage> Next() override {
    if (next_ == files_.size()) return std::nullopt;
    const std::string& file = files_[next_];
    const auto time_ns = static_cast<corvo::TimeNs>(next_ * 33'333'333);
    ++next_;
    return corvo::StreamImage{cv::imread(file, cv::IMREAD_GRAYSCALE), time_ns, cv::Mat(), file};
  }
  bool Skip() override { return next_ < files_.size() && ++next_ > 0; }
  std::optional<int> size() const override { return static_cast<int>(files_.size()); }

 private:
  std::vector<std::string> files_;
  std::size_t next_ = 0;
};

bool Calibrate(const std::string& camera_file, const std::vector<std::string>& files) {
  const corvo::StreamOpener open = [&] { return std::make_unique<ImageFiles>(files); };
  const corvo::CameraCalibration calibration =
      corvo::CalibrateCamera({open}, {corvo::CalibrationModel::kPinhole}, {});
  if (calibration.selected == corvo::kNoId) return false;
  const corvo::CameraCandidate& best = calibration.candidates[calibration.selected];
  std::ofstream(camera_file) << corvo::WriteCameraFile({corvo::Camera(best.adjustment.camera), 30.0,
                                                        "examples/calibrate_camera.cpp",
                                                        corvo::EstimatedSigmas(best)});
  std::cout << "focal length: " << best.adjustment.camera.fx << " px\n";
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: calibrate_camera CAMERA.yaml IMAGE...\n";
    return EXIT_FAILURE;
  }
  try {
    if (Calibrate(argv[1], {argv + 2, argv + argc})) return EXIT_SUCCESS;
    std::cerr << "no camera was found: nothing could be tracked\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
  }
  return EXIT_FAILURE;
}
