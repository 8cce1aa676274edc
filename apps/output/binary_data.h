// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <type_traits>

namespace corvo {

static_assert(std::endian::native == std::endian::little, "binary files are little-endian");

/// Appends the bytes of a number.
template <typename T>
void AppendBytes(const T& value, std::string& bytes) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Returns the number that starts at `bytes` and moves `bytes` behind it.
template <typename T>
T TakeBytes(const char*& bytes) {
  static_assert(std::is_arithmetic_v<T>);
  T value;
  std::memcpy(&value, bytes, sizeof value);
  bytes += sizeof value;
  return value;
}

}  // namespace corvo
