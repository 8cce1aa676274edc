// SPDX-License-Identifier: MIT
#include <optional>
#include <vector>

#include "tests/fuzz/cameras.h"
#include "tests/fuzz/targets.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/refiner.h"

namespace corvo::fuzz {
namespace {

/// Returns a pseudorandom gray level of a cell of a texture.
std::uint8_t Texture(double column, double row, std::uint32_t seed) {
  std::uint32_t hash = 73856093U * static_cast<std::uint32_t>(std::llround(column)) ^
                       19349663U * static_cast<std::uint32_t>(std::llround(row)) ^ 83492791U * seed;
  hash = (hash ^ (hash >> 15)) * 2246822519U;
  return static_cast<std::uint8_t>(hash ^ (hash >> 13));
}

/// Returns the gray level at the end of a ray from `center`: that of one of the slanted planes
/// z = 2 + 0.6 x, which has holes, and z = 5 + 0.6 x.
std::uint8_t Shade(const Eigen::Vector3d& center, const Eigen::Vector3d& ray) {
  const double slope = std::max(ray.z() - 0.6 * ray.x(), 1e-3);
  const double at_zero = 0.6 * center.x() - center.z();
  const double near = (2 + at_zero) / slope, far = (5 + at_zero) / slope;
  const double x = center.x() + near * ray.x(), y = center.y() + near * ray.y();
  if (Texture(x / 0.9, y / 0.9, 1) >= 100) return Texture(x / 0.13, y / 0.13, 3);
  return Texture((center.x() + far * ray.x()) / 0.4, (center.y() + far * ray.y()) / 0.4, 2);
}

/// Draws the planes as seen by a camera whose focal length is its width.
cv::Mat Draw(cv::Size size, const SE3& world_from_camera) {
  cv::Mat image(size, CV_8UC1);
  const Eigen::Matrix3d rotation = world_from_camera.rotation().matrix();
  for (int y = 0; y < size.height; ++y) {
    const Eigen::Vector3d step = rotation.col(0) / size.width;
    Eigen::Vector3d ray = rotation * Eigen::Vector3d(-0.5, (y - 0.5 * size.height) / size.width, 1);
    for (int x = 0; x < size.width; ++x, ray += step) {
      image.at<std::uint8_t>(y, x) = Shade(world_from_camera.translation(), ray);
    }
  }
  return image;
}

OdometryOptions TakeOdometryOptions(Input& input) {
  OdometryOptions options;
  options.extractor.num_features = input.Int(50, 400);
  options.extractor.num_levels = input.Int(1, 6);
  options.initializer.min_matches = 20;
  options.initializer.min_points = input.Int(10, 40);
  options.initializer.min_parallax_deg = input.Real(0, 2);
  options.initializer.min_parallax_sigmas = input.Real(0, 3);
  options.tracker.min_inliers = 15;
  options.relocalizer.min_inliers = 15;
  options.initializer.max_waiting_frames = input.Int(2, 20);
  options.relocalizer.max_lost_s = input.Real(0, 0.5);
  options.relocalizer.max_keyframes = input.Int(1, 20);
  options.calibration.enabled = input.Bool();
  return options;
}

/// Frames one after another, as the bytes of an input tell.
class Recording {
 public:
  Recording(cv::Size size, Odometry& odometry) : size_(size), odometry_(odometry) {}

  /// Processes one image, or does something else that a user may do between images.
  void Step(Input& input) {
    const int kind = input.Int(0, 15);
    Move(input);
    switch (kind) {
      case 8:
        return Process(cv::Mat(size_, CV_8UC1, cv::Scalar(input.Int(0, 255))), {});
      case 9:
        return Process(Noise(input), {});
      case 10:
        return Process(last_, {});
      case 11:
        return Process(Draw(size_, pose_), Mask(input));
      case 12:
        time_ns_ = input.Raw<TimeNs>();
        break;
      case 13:
        pose_ = SE3(SO3::Exp(input.Vector(1)), input.Vector(3));
        break;
      case 14:
        return Finish();
      case 15:
        return input.Int(0, 3) == 0 ? odometry_.Reset() : ProcessInvalid(input);
      default:
        break;
    }
    Process(Draw(size_, pose_), {});
  }

  void Finish() {
    const Trajectory trajectory = odometry_.Finish();
    for (const FrameResult& frame : trajectory.frames) RequireFrame(frame);
    Require(odometry_.camera().parameters().IsValid(), "the camera is valid");
    Require(odometry_.camera_estimate().difference.allFinite(), "the camera is finite");
  }

 private:
  void Move(Input& input) {
    const double turn = input.Real(-0.03, 0.03);
    const Eigen::Vector3d step = input.Vector(0.15);
    pose_ = pose_ * SE3(SO3::Exp({0, turn, 0.3 * turn}), step);
  }

  cv::Mat Noise(Input& input) const {
    cv::Mat image(size_, CV_8UC1);
    std::uint32_t state = input.Raw<std::uint32_t>();
    for (int y = 0; y < size_.height; ++y) {
      for (int x = 0; x < size_.width; ++x) {
        state = state * 1664525U + 1013904223U;
        image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(state >> 24);
      }
    }
    return image;
  }

  cv::Mat Mask(Input& input) const {
    cv::Mat mask(size_, CV_8UC1, cv::Scalar(255));
    mask.colRange(0, input.Int(0, size_.width)).setTo(0);
    return mask;
  }

  void Process(const cv::Mat& image, const cv::Mat& mask) {
    AllowError([&] {
      const FrameResult frame = odometry_.Process(image, time_ns_, mask);
      RequireFrame(frame);
      Require(frame.time_ns == time_ns_, "a result has the time of its image");
      last_ = image;
    });
    if (__builtin_add_overflow(time_ns_, 33'000'000, &time_ns_)) time_ns_ = 0;
  }

  /// Passes an image or mask that is not allowed.
  void ProcessInvalid(Input& input) {
    const int type = input.Bool() ? CV_8UC3 : CV_8UC1;
    Process(cv::Mat(input.Int(0, 20), input.Int(0, 20), type, cv::Scalar::all(7)), {});
    Process(Draw(size_, pose_), cv::Mat(3, 3, CV_8UC1, cv::Scalar(1)));
  }

  static void RequireFrame(const FrameResult& frame) {
    Require(!frame.world_from_camera || IsFinite(*frame.world_from_camera), "poses are finite");
    Require(!frame.world_from_camera || frame.world_from_camera_rotation, "poses have rotations");
    Require(
        !frame.world_from_camera_rotation || frame.world_from_camera_rotation->matrix().allFinite(),
        "rotations are finite");
    Require(frame.world_from_camera.has_value() == (frame.state == State::kTracking),
            "a frame has a pose exactly if it is tracked");
    Require(!frame.relative_pose || (frame.relative_pose->covariance.allFinite() &&
                                     IsFinite(frame.relative_pose->reference_from_camera)),
            "relative poses and covariances are finite");
    Require(std::isfinite(frame.parallax_deg), "the parallax is finite");
  }

  cv::Size size_;
  Odometry& odometry_;
  SE3 pose_;
  TimeNs time_ns_ = 0;
  cv::Mat last_;
};

}  // namespace

void FuzzOdometry(Bytes bytes) {
  constexpr int kMaxSteps = 16;
  Input input(bytes);
  const int width = input.Int(48, 240), height = input.Int(48, 180);
  const cv::Size size(width, height);
  const OdometryOptions options = TakeOdometryOptions(input);
  const bool is_common = input.Int(0, 3) != 0, is_refined = input.Bool();
  CameraParameters camera = TakeCamera(size.width, size.height, is_common, input);
  if (is_common) camera.fx = camera.fy = size.width;
  AllowError([&] {
    Odometry odometry(Camera(camera), options, input.Int(1, 2));
    ObservationLog log;
    if (is_refined) odometry.SetObservationCallback(log.Callback());
    Recording recording(size, odometry);
    for (int step = 0; step < kMaxSteps && !input.empty(); ++step) recording.Step(input);
    recording.Finish();
    if (!is_refined) return;
    const Refinement refinement = Refine(odometry, log);
    for (const FrameResult& frame : refinement.trajectory.frames) {
      Require(!frame.world_from_camera || IsFinite(*frame.world_from_camera), "poses are finite");
    }
  });
}

}  // namespace corvo::fuzz
