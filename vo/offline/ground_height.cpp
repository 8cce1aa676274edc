// SPDX-License-Identifier: MIT
#include "vo/offline/ground_height.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace corvo {
namespace {

/// Standard deviation of the logarithm of the height of a point of the ground: unevenness and
/// triangulation. On KITTI, the points of a road scatter by 0.02 to 0.03.
constexpr double kPointSigma = 0.03;
constexpr double kGroundShare = 0.5;  ///< Assumed share of the points that lie on the ground.
/// The points of a place share the unevenness of its ground, so each counts as a fraction of an
/// independent one: on KITTI, the means of 40 points scatter by 0.012, not by 0.03 / sqrt(40).
constexpr double kPointWeight = 1.0 / 6;
/// Standard deviation of the drift of the scale's logarithm along one camera height of the path.
constexpr double kDrift = 0.001;
constexpr double kNodeSpacing = 10;     ///< Distance between nodes of the filter, in heights.
constexpr double kBin = 0.002;          ///< Width of the filter's bins of the logarithm.
constexpr double kMaxHeightFactor = 4;  ///< Heights may differ by this from the most frequent one.
constexpr double kMinEvidence = 5;      ///< "Very strong": Kass and Raftery, 1995.

/// The logarithm of the height of the ground that a point would be of.
struct Sample {
  int place = 0;
  double log_height = 0;
};

/// Returns the samples of the points near the path, for a camera that is turned by `roll`.
std::vector<Sample> SamplesOf(const std::vector<PassedPoint>& points, double roll) {
  constexpr double kMaxRight = 2, kMaxBeyond = 1;  // In heights.
  std::vector<Sample> samples;
  for (const PassedPoint& point : points) {
    const double below = std::cos(roll) * point.below + std::sin(roll) * point.right;
    const double right = std::cos(roll) * point.right - std::sin(roll) * point.below;
    const bool is_near =
        std::abs(right) <= kMaxRight * below && std::abs(point.beyond) <= kMaxBeyond * below;
    if (is_near && below > 0) samples.push_back({point.place, std::log(below)});
  }
  return samples;
}

/// Returns the most frequent logarithm of a height: the one with the most samples within two
/// standard deviations.
double MostFrequent(const std::vector<Sample>& samples) {
  std::vector<double> sorted;
  for (const Sample& sample : samples) sorted.push_back(sample.log_height);
  std::sort(sorted.begin(), sorted.end());
  std::ptrdiff_t most = 0;
  double best = 0;
  for (auto first = sorted.begin(); first != sorted.end(); ++first) {
    const auto last = std::upper_bound(first, sorted.end(), *first + 4 * kPointSigma);
    if (last - first <= most) continue;
    most = last - first;
    best = *first + 2 * kPointSigma;
  }
  return best;
}

/// The posterior of one roll.
struct HeightPosterior {
  std::vector<GroundHeight::AtPlace> nodes;
  double evidence = 0;
};

/// A discrete Bayes filter of the logarithm of the height along the path.
class HeightFilter {
 public:
  /// `lowest` is the logarithm of the lowest height.
  HeightFilter(double lowest, int num_nodes)
      : lowest_(lowest),
        num_bins_(static_cast<int>(std::lround(2 * std::log(kMaxHeightFactor) / kBin))),
        log_likelihood_(Eigen::ArrayXXd::Zero(num_bins_, num_nodes)) {
    const double sigma = kDrift * std::sqrt(kNodeSpacing) / kBin;
    const int reach = static_cast<int>(std::ceil(4 * sigma));
    kernel_.resize(2 * reach + 1);
    for (int i = -reach; i <= reach; ++i)
      kernel_[i + reach] = std::exp(-0.5 * i * i / sigma / sigma);
    kernel_ /= kernel_.sum();
  }

  /// Multiplies the likelihood of a node by that of a sample relative to no ground.
  void Add(int node, double log_height) {
    constexpr double kReach = 6;  // In standard deviations; further away, it is an outlier.
    const double outlier = 1 / (num_bins_ * kBin);
    const double peak = 1 / std::sqrt(2 * std::numbers::pi) / kPointSigma;
    const double middle = (log_height - lowest_) / kBin, reach = kReach * kPointSigma / kBin;
    const int last = static_cast<int>(std::min<double>(num_bins_ - 1, middle + reach));
    for (int i = static_cast<int>(std::max(0.0, middle - reach)); i <= last; ++i) {
      const double z = (LogHeight(i) - log_height) / kPointSigma;
      const double ratio = peak * std::exp(-0.5 * z * z) / outlier;
      log_likelihood_(i, node) +=
          kPointWeight * std::log1p(ratio * kGroundShare / (1 - kGroundShare));
    }
    evidence_of_outliers_ += kPointWeight * std::log(1 - kGroundShare);
  }

  HeightPosterior Solve() const {
    const int num_nodes = static_cast<int>(log_likelihood_.cols());
    HeightPosterior posterior;
    posterior.evidence = evidence_of_outliers_;
    std::vector<Eigen::ArrayXd> forward(num_nodes);
    Eigen::ArrayXd belief = Eigen::ArrayXd::Constant(num_bins_, 1.0 / num_bins_);
    for (int n = 0; n < num_nodes; ++n) {
      if (n > 0) belief = Drift(belief);
      posterior.evidence += Update(n, belief);
      forward[n] = belief;
    }
    Eigen::ArrayXd backward = Eigen::ArrayXd::Ones(num_bins_);
    posterior.nodes.resize(num_nodes);
    for (int n = num_nodes - 1; n >= 0; --n) {
      posterior.nodes[n] = Moments(forward[n] * backward);
      Update(n, backward);
      backward = Drift(backward);
    }
    return posterior;
  }

 private:
  double LogHeight(int bin) const { return lowest_ + (bin + 0.5) * kBin; }

  /// Multiplies a belief by the likelihood of a node, normalizes it and returns the logarithm of
  /// the factor.
  double Update(int node, Eigen::ArrayXd& belief) const {
    const double largest = log_likelihood_.col(node).maxCoeff();
    belief *= (log_likelihood_.col(node) - largest).exp();
    const double sum = belief.sum();
    belief /= sum;
    return std::log(sum) + largest;
  }

  Eigen::ArrayXd Drift(const Eigen::ArrayXd& belief) const {
    const int reach = static_cast<int>(kernel_.size() / 2);
    Eigen::ArrayXd moved = Eigen::ArrayXd::Zero(num_bins_);
    for (int shift = -reach; shift <= reach; ++shift) {
      const int size = num_bins_ - std::abs(shift);
      moved.segment(std::max(0, shift), size) +=
          kernel_[shift + reach] * belief.segment(std::max(0, -shift), size);
    }
    return moved;
  }

  GroundHeight::AtPlace Moments(const Eigen::ArrayXd& belief) const {
    const Eigen::ArrayXd bins =
        Eigen::ArrayXd::LinSpaced(num_bins_, LogHeight(0), LogHeight(num_bins_ - 1));
    const double sum = belief.sum();
    const double mean = (belief * bins).sum() / sum;
    return {mean, std::sqrt((belief * (bins - mean).square()).sum() / sum)};
  }

  double lowest_;
  int num_bins_;
  Eigen::ArrayXXd log_likelihood_;  ///< Of bin and node, relative to no point on the ground.
  double evidence_of_outliers_ = 0;
  Eigen::ArrayXd kernel_;
};

/// The nodes of the filter, evenly spaced along a path.
struct Nodes {
  double spacing = 0;
  int count = 0;

  int Nearest(double distance) const {
    return std::clamp(static_cast<int>(std::lround(distance / spacing)), 0, count - 1);
  }

  GroundHeight::AtPlace Interpolate(const std::vector<GroundHeight::AtPlace>& values,
                                    double distance) const {
    const int before = std::clamp(static_cast<int>(distance / spacing), 0, count - 1);
    const int after = std::min(before + 1, count - 1);
    const double share = std::clamp(distance / spacing - before, 0.0, 1.0);
    const auto mix = [share](double a, double b) { return (1 - share) * a + share * b; };
    return {mix(values[before].log_height, values[after].log_height),
            mix(values[before].sigma, values[after].sigma)};
  }
};

GroundHeight Evaluate(const CameraPath& path, const std::vector<Sample>& samples, double roll) {
  const double typical = MostFrequent(samples);
  Nodes nodes{kNodeSpacing * std::exp(typical)};
  nodes.count = 1 + static_cast<int>(std::ceil(path.places().back().distance / nodes.spacing));
  HeightFilter filter(typical - std::log(kMaxHeightFactor), nodes.count);
  for (const Sample& sample : samples) {
    filter.Add(nodes.Nearest(path.places()[sample.place].distance), sample.log_height);
  }
  const HeightPosterior posterior = filter.Solve();
  GroundHeight ground;
  ground.roll = roll;
  ground.evidence = posterior.evidence;
  for (const CameraPath::Place& place : path.places()) {
    ground.places.push_back(nodes.Interpolate(posterior.nodes, place.distance));
  }
  return ground;
}

}  // namespace

std::optional<GroundHeight> FindGround(const CameraPath& path,
                                       const std::vector<PassedPoint>& points) {
  constexpr int kMaxRollDeg = 5;
  std::optional<GroundHeight> best;
  for (int roll_deg = -kMaxRollDeg; roll_deg <= kMaxRollDeg; ++roll_deg) {
    const double roll = roll_deg * std::numbers::pi / 180;
    const std::vector<Sample> samples = SamplesOf(points, roll);
    if (samples.empty()) continue;
    GroundHeight ground = Evaluate(path, samples, roll);
    if (ground.evidence >= kMinEvidence && (!best || ground.evidence > best->evidence)) {
      best = std::move(ground);
    }
  }
  return best;
}

}  // namespace corvo
