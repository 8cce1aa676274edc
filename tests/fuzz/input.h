// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "orb/error.h"
#include "vo/lie/se3.h"

namespace corvo::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Reports a broken promise and ends the process, so that libFuzzer keeps the input.
inline void Require(bool condition, const char* promise) {
  if (condition) return;
  std::fprintf(stderr, "corvo: broken promise: %s\n", promise);
  std::abort();
}

/// Calls `function`, which may throw corvo::Error with a message, but nothing else.
template <typename Function>
void AllowError(Function&& function) {
  try {
    std::forward<Function>(function)();
  } catch (const Error& error) {
    Require(error.what()[0] != '\0', "an error has a message");
  }
}

inline bool IsFinite(const SE3& pose) { return pose.data().allFinite(); }

/// Turns the bytes of an input into numbers, from the first byte to the last. After the last byte
/// every number is that of zero bytes.
class Input {
 public:
  explicit Input(Bytes bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }
  Bytes rest() const { return bytes_; }
  std::string Text() const { return {bytes_.begin(), bytes_.end()}; }

  template <typename T>
  T Raw() {
    T value{};
    const std::size_t size = std::min(sizeof(T), bytes_.size());
    if (size > 0) std::memcpy(&value, bytes_.data(), size);  // The data of no bytes may be null.
    bytes_ = bytes_.subspan(size);
    return value;
  }

  bool Bool() { return (Raw<std::uint8_t>() & 1) != 0; }

  /// Returns an integer in [min, max], where max - min is below 65536. Takes a byte, or two if the
  /// range needs them.
  int Int(int min, int max) {
    const int count = max - min + 1;
    const int value = count > 256 ? Raw<std::uint16_t>() : Raw<std::uint8_t>();
    return min + value % count;
  }

  /// Returns a number in [min, max] with 16 bits of resolution.
  double Real(double min, double max) { return min + (max - min) * Raw<std::uint16_t>() / 65535.0; }

  /// Returns a finite number of any magnitude up to `bound`, among them 0, -0 and denormal numbers.
  double Number(double bound) {
    const double value = Raw<double>();
    if (!std::isfinite(value)) return 0;
    return std::abs(value) <= bound ? value : std::fmod(value, bound);
  }

  Eigen::Vector3d Vector(double bound) {
    const double x = Real(-bound, bound);
    const double y = Real(-bound, bound);
    const double z = Real(-bound, bound);
    return {x, y, z};
  }

 private:
  Bytes bytes_;
};

}  // namespace corvo::fuzz
