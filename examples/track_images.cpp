// SPDX-License-Identifier: MIT
// Tracks a camera through images: track_images IMAGE...
#include <iostream>

#include <corvo/vo/odometry.h>
#include <opencv2/imgcodecs.hpp>

int main(int argc, char** argv) {
  const corvo::Camera camera(
      {.width = 640, .height = 480, .fx = 525, .fy = 525, .cx = 319.5, .cy = 239.5});
  corvo::Odometry odometry(camera);
  for (int i = 1; i < argc; ++i) {
    const cv::Mat image = cv::imread(argv[i], cv::IMREAD_GRAYSCALE);
    const corvo::FrameResult frame = odometry.Process(image, (i - 1) * 33'333'333LL);  // 30 Hz
    std::cerr << argv[i] << ' ' << ToString(frame.state) << ' ' << ToString(frame.reason) << '\n';
  }
  for (const corvo::TimedPose& pose : odometry.Finish().PosedFrames()) {
    std::cout << pose.time_ns << ' ' << pose.world_from_camera.translation().transpose() << '\n';
  }
}
