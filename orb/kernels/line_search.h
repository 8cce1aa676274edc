#pragma once

#include <cstdint>

namespace corvo::orb::kernels {

/// Points, and how far from a line each may lie.
struct LinePoints {
  const double* x;
  const double* y;
  const double* max_squared_distances;
  int count;
};

/// The line a x + b y + c = 0.
struct Line {
  double a;
  double b;
  double c;
};

/// Writes to `found`, which has room for all, the indices of the points near `line`, in ascending
/// order, and returns how many they are.
int FindNearLine(const LinePoints& points, const Line& line, std::int32_t* found);

namespace scalar {
int FindNearLine(const LinePoints& points, const Line& line, std::int32_t* found);
}  // namespace scalar

}  // namespace corvo::orb::kernels
