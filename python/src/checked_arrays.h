// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <nanobind/ndarray.h>
#include <Eigen/Core>

#include "orb/types.h"

namespace corvo::python {

using CheckedArray = nanobind::ndarray<nanobind::ro, nanobind::device::cpu>;

/// Throws a corvo::Error: "<name> has <property> <value>; allowed is <allowed>".
[[noreturn]] void ThrowNotAllowed(std::string_view name, std::string_view property,
                                  nanobind::handle value, std::string_view allowed);

/// Returns an array of `dtype`, such as "uint8". Throws corvo::Error, which calls it `name`, for
/// anything else: nothing is converted.
CheckedArray ToCheckedArray(nanobind::handle object, const char* dtype, std::string_view name);

/// Returns a copy of points, an array of float64 of shape (n, Size); its rows may lie apart. Throws
/// corvo::Error for anything else.
template <int Size>
std::vector<Eigen::Vector<double, Size>> ToPoints(nanobind::handle array, std::string_view name);

/// Descriptors that share the memory of an array, or are a copy of one that is not aligned.
class DescriptorView {
 public:
  /// Throws corvo::Error unless the array is of uint8, of shape (n, 32), and contiguous. The array
  /// must outlive the view.
  DescriptorView(nanobind::handle array, std::string_view name);

  std::span<const orb::Descriptor> span() const { return span_; }

 private:
  std::vector<orb::Descriptor> copy_;
  std::span<const orb::Descriptor> span_;
};

}  // namespace corvo::python
