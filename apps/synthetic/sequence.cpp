// SPDX-License-Identifier: MIT
#include "apps/synthetic/sequence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <opencv2/core.hpp>

#include "apps/synthetic/random.h"
#include "orb/error.h"

namespace corvo::synthetic {
namespace {

constexpr int kBlurMoments = 12;    ///< Number of renderings averaged for a blurred image.
constexpr double kTurnAngle = 0.7;  ///< Angle of the turn to either side, rad.

/// Returns an approximately standard normal sample by the central limit theorem: the sum of twelve
/// uniform samples of variance 1/12, so its magnitude is at most 6. Exact integers up to the last
/// step.
double StandardNormal(std::uint64_t seed, std::int64_t frame, std::int64_t pixel) {
  const std::uint64_t key = Hash(seed, frame, pixel);
  int sum = 0;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t bits = Mix(key + kGolden * static_cast<std::uint64_t>(i));
    for (int shift = 0; shift < 64; shift += 16) sum += static_cast<int>(bits >> shift & 0xffff);
  }
  return (sum - 6 * 65535) / 65536.0;
}

void AddGaussianNoise(cv::Mat* image, const SequenceOptions& options, int frame) {
  for (int y = 0; y < image->rows; ++y) {
    std::uint8_t* row = image->ptr<std::uint8_t>(y);
    for (int x = 0; x < image->cols; ++x) {
      const double noise =
          options.noise_sigma * StandardNormal(options.noise_seed, frame, y * image->cols + x);
      row[x] = static_cast<std::uint8_t>(std::clamp(row[x] + noise + 0.5, 0.0, 255.0));
    }
  }
}

/// Returns the path with a stop inserted for the turn.
std::vector<SE3> InsertTurn(const std::vector<SE3>& path, const TimeSpan& turn,
                            double frame_rate_hz) {
  std::vector<SE3> poses;
  std::size_t next = 0;
  while (poses.size() < path.size()) {
    const double seconds = static_cast<double>(poses.size()) / frame_rate_hz;
    if (turn.Contains(seconds)) {
      const double turns = (seconds - turn.start_s) / turn.duration_s;
      const double angle = kTurnAngle * std::sin(2 * std::numbers::pi * turns);
      poses.push_back(path[next] * SE3(SO3::Exp({0, angle, 0}), Eigen::Vector3d::Zero()));
    } else {
      poses.push_back(path[next++]);
    }
  }
  return poses;
}

}  // namespace

void SequenceOptions::Validate() const {
  CheckRange("frames", frames, 1, 1000000);
  if (width != 0) CheckRange("width", width, 64, 8192);
  CheckRange("noise_sigma", noise_sigma, 0.0, 100.0);
  CheckSpan("turn", turn);
  effects.Validate();
}

Sequence::Sequence(std::string name, std::shared_ptr<const Scene> scene, const Camera& camera,
                   double frame_rate_hz, const std::vector<SE3>& scene_from_camera,
                   const SequenceOptions& options)
    : name_(std::move(name)),
      scene_(std::move(scene)),
      renderer_(camera),
      frame_rate_hz_(frame_rate_hz),
      options_(options),
      scene_from_world_(scene_from_camera.at(0)) {
  options.Validate();
  if (options.effects.moving_share > 0) {
    const auto with_boards = std::make_shared<Scene>(*scene_);
    boards_.emplace(camera, options.effects.moving_share, with_boards.get());
    scene_ = with_boards;
  }
  const SE3 world_from_scene = scene_from_world_.Inverse();
  for (const SE3& pose : InsertTurn(scene_from_camera, options.turn, frame_rate_hz)) {
    const double seconds = static_cast<double>(poses_.size()) / frame_rate_hz;
    const SE3 world_from_camera = poses_.empty() ? SE3() : world_from_scene * pose;
    poses_.push_back({static_cast<TimeNs>(std::llround(1e9 * seconds)), world_from_camera});
  }
}

SE3 Sequence::scene_from_camera(int frame) const {
  return scene_from_world_ * poses_.at(static_cast<std::size_t>(frame)).world_from_camera;
}

SE3 Sequence::PoseAt(double frame) const {
  const double inside = std::clamp(frame, 0.0, static_cast<double>(size() - 1));
  const int before = static_cast<int>(inside);
  const SE3 pose = scene_from_camera(before);
  if (inside == before) return pose;
  const SE3 step = pose.Inverse() * scene_from_camera(before + 1);
  return pose * step.Power(inside - before);
}

std::vector<Quad> Sequence::MovingQuadsAt(double frame) const {
  return boards_ ? boards_->At(PoseAt(frame), SecondsAt(frame)) : std::vector<Quad>();
}

cv::Mat Sequence::RenderMoment(double frame) const {
  return renderer_.Render(*scene_, PoseAt(frame), MovingQuadsAt(frame));
}

cv::Mat Sequence::RenderBlurred(int frame) const {
  cv::Mat sum = cv::Mat::zeros(camera().height(), camera().width(), CV_32SC1);
  for (int i = 0; i < kBlurMoments; ++i) {
    const double moment = frame + (i + 0.5) / kBlurMoments - 0.5;
    cv::add(sum, RenderMoment(moment), sum, cv::noArray(), CV_32S);
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_8U, 1.0 / kBlurMoments);
  return mean;
}

cv::Mat Sequence::Render(int frame) const {
  const double seconds = SecondsAt(frame);
  const bool blurred = options_.effects.blur.Contains(seconds);
  cv::Mat image = blurred ? RenderBlurred(frame) : RenderMoment(frame);
  ApplyLight(&image, options_.effects, seconds);
  if (options_.noise_sigma > 0) AddGaussianNoise(&image, options_, frame);
  return image;
}

cv::Mat Sequence::RenderDepth(int frame) const {
  return renderer_.RenderDepth(*scene_, scene_from_camera(frame), MovingQuadsAt(frame));
}

}  // namespace corvo::synthetic
