// SPDX-License-Identifier: MIT
// Tracks a camera through images, then adjusts the whole sequence:
// refine_sequence CAMERA.yaml TRAJECTORY.tum IMAGE...
#include <cstdlib>
#include <exception>
#include <iostream>

#include <corvo/vo/io/config.h>
#include <corvo/vo/io/trajectory_io.h>
#include <corvo/vo/odometry.h>
#include <corvo/vo/offline/refiner.h>
#include <opencv2/imgcodecs.hpp>

namespace {

void Run(int argc, char** argv) {
  const corvo::CameraFile file = corvo::ReadCameraFile(argv[1]);
  const corvo::OdometryOptions options;
  corvo::Odometry odometry(file.Prior(options.calibration), options);
  corvo::ObservationLog log;
  odometry.SetObservationCallback(log.Callback());

  const double step_ns = 1e9 / file.frame_rate_hz.value_or(30);
  for (int i = 3; i < argc; ++i) {
    const auto time_ns = static_cast<corvo::TimeNs>((i - 3) * step_ns);
    odometry.Process(cv::imread(argv[i], cv::IMREAD_GRAYSCALE), time_ns);
  }
  odometry.Finish();

  const corvo::Refinement refinement = corvo::Refine(odometry, log);
  corvo::WriteTum(argv[2], refinement.trajectory.PosedFrames());
  std::cout << refinement.num_adjusted
            << " frames adjusted: " << ToString(refinement.adjustment.status) << ", "
            << refinement.adjustment.inlier_rms_px << " px rms\n"
            << refinement.landmarks.size() << " landmarks\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "usage: refine_sequence CAMERA.yaml TRAJECTORY.tum IMAGE...\n";
    return EXIT_FAILURE;
  }
  try {
    Run(argc, argv);
  } catch (const std::exception& error) {  // corvo::Error names the cause.
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
