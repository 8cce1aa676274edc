// SPDX-License-Identifier: MIT
#include "apps/synthetic/street_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace corvo::synthetic {
namespace {

constexpr double kStep = 0.1;     ///< m
constexpr double kSmoothing = 6;  ///< Length over which the curvature changes, m.
constexpr double kQuarterTurn = 1.57079632679489661923;
constexpr double kTightRadius = 12, kGentleRadius = 70;  ///< m

struct Section {
  double length;
  double curvature;
};

constexpr std::array<Section, 14> kPeriod = {{
    {40, 0},
    {20, 1 / kGentleRadius},
    {40, -1 / kGentleRadius},
    {20, 1 / kGentleRadius},
    {10, 0},
    {kQuarterTurn * kTightRadius, 1 / kTightRadius},
    {30, 0},
    {40, 0},
    {20, -1 / kGentleRadius},
    {40, 1 / kGentleRadius},
    {20, -1 / kGentleRadius},
    {10, 0},
    {kQuarterTurn * kTightRadius, -1 / kTightRadius},
    {30, 0},
}};

/// Returns the heading after `distance` meters of a path whose curvature is constant in each
/// section.
double AngularHeading(double distance) {
  double heading = 0;
  for (std::size_t i = 0; distance > 0; i = (i + 1) % kPeriod.size()) {
    heading += kPeriod[i].curvature * std::min(distance, kPeriod[i].length);
    distance -= kPeriod[i].length;
  }
  return heading;
}

}  // namespace

Eigen::Vector2d StreetPath::Place::Inflated(double left) const {
  return position + left * Eigen::Vector2d(-std::sin(heading), std::cos(heading));
}

StreetPath::StreetPath(double length) {
  Place place;
  for (double distance = 0; distance <= length; distance += kStep) {
    place.curvature =
        (AngularHeading(distance + kSmoothing / 2) - AngularHeading(distance - kSmoothing / 2)) /
        kSmoothing;
    places_.push_back(place);
    const double middle = place.heading + 0.5 * kStep * place.curvature;
    place.position += kStep * Eigen::Vector2d(std::cos(middle), std::sin(middle));
    place.heading += kStep * place.curvature;
  }
}

double StreetPath::length() const { return kStep * static_cast<double>(places_.size() - 1); }

StreetPath::Place StreetPath::At(double distance) const {
  const double index =
      std::clamp(distance / kStep, 0.0, static_cast<double>(places_.size()) - 1.001);
  const Place& before = places_[static_cast<std::size_t>(index)];
  const Place& after = places_[static_cast<std::size_t>(index) + 1];
  const double blend = index - std::floor(index);
  Place place;
  place.position = (1 - blend) * before.position + blend * after.position;
  place.heading = (1 - blend) * before.heading + blend * after.heading;
  place.curvature = (1 - blend) * before.curvature + blend * after.curvature;
  return place;
}

double StreetPath::Clearance(const Eigen::Vector2d& point, double from, double to) const {
  double least = std::numeric_limits<double>::infinity();
  for (double distance = std::max(from, 0.0); distance <= std::min(to, length()); distance += 0.5) {
    least = std::min(least, (At(distance).position - point).norm());
  }
  return least;
}

}  // namespace corvo::synthetic
