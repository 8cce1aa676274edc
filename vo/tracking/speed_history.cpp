// SPDX-License-Identifier: MIT
#include "vo/tracking/speed_history.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "vo/math/median.h"

namespace corvo {
namespace {

/// Returns the spread of the logarithms around that of the median, as a standard deviation.
double LogSpread(const std::vector<double>& speeds, double median) {
  constexpr double kNormalFromMedian = 1.4826;
  std::vector<double> deviations;
  deviations.reserve(speeds.size());
  for (const double speed : speeds) deviations.push_back(std::abs(std::log(speed / median)));
  return kNormalFromMedian * Median(std::move(deviations));
}

}  // namespace

void SpeedHistory::Add(const Frame& earlier, const Frame& later) {
  const Eigen::Vector3d vector =
      later.world_from_camera.translation() - earlier.world_from_camera.translation();
  const double speed = vector.norm() / ToSeconds(later.time_ns - earlier.time_ns);
  if (!(speed > 0)) return;
  motions_.push_back({later.time_ns, vector, speed});
  while (ToSeconds(later.time_ns - motions_.front().time_ns) >= options_.speed_window_s) {
    motions_.pop_front();
  }
}

void SpeedHistory::Transform(const Sim3& to_from_from) {
  for (Motion& motion : motions_) {
    motion.vector = to_from_from.scale() * (to_from_from.rotation() * motion.vector);
    motion.speed *= to_from_from.scale();
  }
}

bool SpeedHistory::IsNoise() const {
  double product = 0;
  for (std::size_t i = 1; i < motions_.size(); ++i) {
    product += motions_[i - 1].vector.dot(motions_[i].vector);
  }
  return product < 0;
}

std::optional<SpeedGuess> SpeedHistory::Predict(TimeNs time_ns) const {
  if (motions_.empty()) return std::nullopt;
  const bool are_few = static_cast<int>(motions_.size()) < options_.min_speeds;
  if (!are_few && IsNoise()) return std::nullopt;
  std::vector<double> speeds;
  for (const Motion& motion : motions_) speeds.push_back(motion.speed);
  const double median = Median(speeds);
  double spread = LogSpread(speeds, median);
  if (are_few) spread = std::max(spread, options_.unknown_speed_spread);
  const double gap_s = std::max(0.0, ToSeconds(time_ns - motions_.back().time_ns));
  const double growth = options_.speed_growth;
  return SpeedGuess{median, std::sqrt(spread * spread * (1 + gap_s) + growth * growth * gap_s)};
}

}  // namespace corvo
