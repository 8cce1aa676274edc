// The whole odometry, over drawn frames: cards at several depths, from a camera that moves
// sideways.

#include <cstdlib>
#include <iostream>

#include <corvo/vo/odometry.h>
#include <opencv2/core.hpp>

namespace {

constexpr int kCards = 80;
constexpr int kSpots = 12;  // on each card

/// What a camera `offset_m` to the right sees: cards with spots, the far ones first.
cv::Mat Draw(const corvo::Camera& camera, double offset_m) {
  cv::Mat image(camera.height(), camera.width(), CV_8UC1, cv::Scalar(128));
  cv::RNG random(7);
  for (int i = 0; i < kCards; ++i) {
    const double z = 12.0 - 9.0 * i / kCards;
    const double x = random.uniform(-1.0, 1.0) * z - offset_m;
    const double y = random.uniform(-0.6, 0.6) * z;
    for (int spot = 0; spot <= kSpots; ++spot) {
      const double half_side_m = spot == 0 ? 0.8 : random.uniform(0.05, 0.25);
      const double reach_m = 0.8 - half_side_m;
      const Eigen::Vector3d center(x + random.uniform(-1.0, 1.0) * reach_m,
                                   y + random.uniform(-1.0, 1.0) * reach_m, z);
      const Eigen::Vector2d pixel = camera.Project(center).value();
      const double half_side = camera.fx() * half_side_m / z;
      const cv::Rect square(cv::Point2d(pixel.x() - half_side, pixel.y() - half_side),
                            cv::Point2d(pixel.x() + half_side, pixel.y() + half_side));
      image(square & cv::Rect({}, image.size())).setTo(random.uniform(0, 256));
    }
  }
  return image;
}

}  // namespace

int main() {
  const corvo::Camera camera(
      {.width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120});
  corvo::Odometry odometry(camera);
  for (int i = 0; i < 16; ++i) {
    const corvo::FrameResult frame = odometry.Process(Draw(camera, 0.1 * i), i * 33'333'333LL);
    std::cout << ToString(frame.state) << ' ' << ToString(frame.reason) << '\n';
  }
  const std::size_t posed = odometry.GetTrajectory().PosedFrames().size();
  std::cout << posed << " frames posed\n";
  return posed >= 6 ? EXIT_SUCCESS : EXIT_FAILURE;
}
