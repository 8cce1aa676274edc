#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include <corvo/vo/odometry.h>

int main(int argc, char** argv) {  // The images of a 30 Hz sequence, in order.
  const corvo::Camera camera(
      {.width = 640, .height = 480, .fx = 585, .fy = 585, .cx = 320, .cy = 240});
  corvo::Odometry odometry(camera);
  for (int i = 1; i < argc; ++i) {
    const cv::Mat image = cv::imread(argv[i], cv::IMREAD_GRAYSCALE);
    const corvo::FrameResult frame = odometry.Process(image, (i - 1) * 33'333'333LL);
    std::cerr << ToString(frame.state) << ' ' << ToString(frame.reason) << '\n';
  }
  for (const corvo::TimedPose& pose : odometry.GetTrajectory().PosedFrames()) {
    const Eigen::Vector3d camera_in_world = pose.world_from_camera.translation();
    std::cout << pose.time_ns << ' ' << camera_in_world.transpose() << '\n';
  }
}
