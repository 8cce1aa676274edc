// SPDX-License-Identifier: MIT
#include "orb/kernels/directions.h"

#include <algorithm>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/directions.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

#ifndef CORVO_ORB_KERNELS_DIRECTION_CONSTANTS
#define CORVO_ORB_KERNELS_DIRECTION_CONSTANTS
namespace corvo::orb::kernels {

constexpr double kTan22 = 0.41421356237309503;  // of 22.5 degrees
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kLastTerm = 13;  // The series of atan is cut off after t^13 / 13, |t| <= kTan22.

}  // namespace corvo::orb::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::FindDirectionsDeg;
#else
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<double>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes SlopesDeg(Lanes rise, Lanes run) {
  const Tag d;
  const auto steep = hn::Gt(rise, hn::Mul(hn::Set(d, kTan22), run));
  const Lanes t = hn::Div(hn::IfThenElse(steep, hn::Sub(rise, run), rise),
                          hn::IfThenElse(steep, hn::Add(rise, run), run));
  const Lanes square = hn::Mul(t, t);
  Lanes sum = hn::Zero(d);
  for (int k = kLastTerm; k >= 1; k -= 2) {
    sum = hn::Sub(hn::Set(d, 1.0 / k), hn::Mul(square, sum));
  }
  return hn::Add(hn::IfThenElseZero(steep, hn::Set(d, 45.0)),
                 hn::Mul(hn::Mul(hn::Set(d, kDegrees), t), sum));
}

HWY_INLINE Lanes DirectionsDeg(Lanes x, Lanes y) {
  const Tag d;
  const Lanes zero = hn::Zero(d);
  const auto half = hn::Lt(y, zero);
  const Lanes half_x = hn::IfThenElse(half, hn::Neg(x), x);
  const Lanes half_y = hn::IfThenElse(half, hn::Neg(y), y);
  const auto quarter = hn::Le(half_x, zero);
  const Lanes run = hn::IfThenElse(quarter, half_y, half_x);
  const Lanes rise = hn::IfThenElse(quarter, hn::Neg(half_x), half_y);
  const Lanes slope = SlopesDeg(hn::Min(rise, run), hn::Max(rise, run));
  const Lanes turned = hn::Add(hn::IfThenElseZero(half, hn::Set(d, 180.0)),
                               hn::IfThenElseZero(quarter, hn::Set(d, 90.0)));
  const Lanes octant = hn::IfThenElse(hn::Gt(rise, run), hn::Sub(hn::Set(d, 90.0), slope), slope);
  const auto is_null = hn::And(hn::Eq(x, zero), hn::Eq(y, zero));
  return hn::IfThenZeroElse(is_null, hn::Add(turned, octant));
}

void FindDirectionsDeg(std::span<const DiscMoments> moments, std::span<float> directions_deg) {
  const Tag d;
  const hn::Rebind<std::int32_t, Tag> d32;
  const hn::Rebind<float, Tag> d_float;
  const std::size_t step = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + step <= moments.size(); i += step) {
    hn::Vec<decltype(d32)> x;
    hn::Vec<decltype(d32)> y;
    hn::LoadInterleaved2(d32, &moments[i].x, x, y);
    const Lanes degrees = DirectionsDeg(hn::PromoteTo(d, x), hn::PromoteTo(d, y));
    const auto rounded = hn::DemoteTo(d_float, degrees);
    const auto whole_turn = hn::Ge(rounded, hn::Set(d_float, 360.0F));
    hn::StoreU(hn::IfThenZeroElse(whole_turn, rounded), d_float, &directions_deg[i]);
  }
  scalar::FindDirectionsDeg(moments.subspan(i), directions_deg.subspan(i));
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FindDirectionsDeg);

void FindDirectionsDeg(std::span<const DiscMoments> moments, std::span<float> directions_deg) {
  HWY_DYNAMIC_DISPATCH(FindDirectionsDeg)(moments, directions_deg);
}

namespace scalar {
namespace {

/// Arctangent in degrees of a slope rise / run in [0, 1], run > 0: the series of atan, turned back
/// by 45 degrees where it would converge slowly.
double SlopeDeg(double rise, double run) {
  const bool steep = rise > kTan22 * run;
  const double t = (steep ? rise - run : rise) / (steep ? rise + run : run);
  const double square = t * t;
  double sum = 0.0;
  for (int k = kLastTerm; k >= 1; k -= 2) sum = 1.0 / k - square * sum;
  return (steep ? 45.0 : 0.0) + kDegrees * t * sum;
}

}  // namespace

float DirectionDeg(double x, double y) {
  if (x == 0.0 && y == 0.0) return 0.0F;
  const bool half = y < 0.0;  // Turned by half a turn, then by a quarter: x > 0, y >= 0.
  const double half_x = half ? -x : x;
  const double half_y = half ? -y : y;
  const bool quarter = half_x <= 0.0;
  const double run = quarter ? half_y : half_x;
  const double rise = quarter ? -half_x : half_y;
  const double slope_deg = SlopeDeg(std::min(rise, run), std::max(rise, run));
  const double turned_deg = (half ? 180.0 : 0.0) + (quarter ? 90.0 : 0.0);
  const auto degrees = static_cast<float>(turned_deg + (rise > run ? 90.0 - slope_deg : slope_deg));
  return degrees < 360.0F ? degrees : 0.0F;
}

void FindDirectionsDeg(std::span<const DiscMoments> moments, std::span<float> directions_deg) {
  for (std::size_t i = 0; i < moments.size(); ++i) {
    directions_deg[i] = DirectionDeg(moments[i].x, moments[i].y);
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
