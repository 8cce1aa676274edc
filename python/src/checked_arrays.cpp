// SPDX-License-Identifier: MIT
#include "python/src/checked_arrays.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo::python {

namespace nb = nanobind;

void ThrowNotAllowed(std::string_view name, std::string_view property, nb::handle value,
                     std::string_view allowed) {
  throw Error(
      fmt::format("{} has {} {}; allowed is {}", name, property, nb::str(value).c_str(), allowed));
}

CheckedArray ToCheckedArray(nb::handle object, const char* dtype, std::string_view name) {
  if (!nb::hasattr(object, "dtype")) {
    ThrowNotAllowed(name, "type", object.type().attr("__name__"), "a NumPy array");
  }
  const nb::object given = object.attr("dtype");
  if (!nb::str(given).equal(nb::str(dtype))) ThrowNotAllowed(name, "dtype", given, dtype);
  CheckedArray array;
  if (!nb::try_cast(object, array, false)) {
    ThrowNotAllowed(name, "strides", object.attr("strides"),
                    "multiples of the size of a number, as numpy.ascontiguousarray makes them");
  }
  return array;
}

template <int Size>
std::vector<Eigen::Vector<double, Size>> ToPoints(nb::handle array, std::string_view name) {
  const CheckedArray numbers = ToCheckedArray(array, "float64", name);
  if (numbers.ndim() != 2 || numbers.shape(1) != Size) {
    ThrowNotAllowed(name, "shape", array.attr("shape"), fmt::format("(n, {})", Size));
  }
  const auto* const data = static_cast<const std::byte*>(numbers.data());
  std::vector<Eigen::Vector<double, Size>> points(numbers.shape(0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int k = 0; k < Size; ++k) {
      const std::int64_t offset =
          static_cast<std::int64_t>(i) * numbers.stride(0) + k * numbers.stride(1);
      // The numbers of an array need not be aligned.
      std::memcpy(&points[i][k], data + offset * std::int64_t{sizeof(double)}, sizeof(double));
    }
  }
  return points;
}

template std::vector<Eigen::Vector2d> ToPoints<2>(nb::handle, std::string_view);
template std::vector<Eigen::Vector3d> ToPoints<3>(nb::handle, std::string_view);

DescriptorView::DescriptorView(nb::handle array, std::string_view name) {
  const CheckedArray bytes = ToCheckedArray(array, "uint8", name);
  constexpr std::size_t kSize = sizeof(orb::Descriptor);
  if (bytes.ndim() != 2 || bytes.shape(1) != kSize) {
    ThrowNotAllowed(name, "shape", array.attr("shape"), "(n, 32)");
  }
  const std::size_t count = bytes.shape(0);
  const bool has_rows = bytes.stride(1) == 1 && bytes.stride(0) == std::int64_t{kSize};
  if (count > 0 && !has_rows) {
    ThrowNotAllowed(name, "strides", array.attr("strides"), "those of a contiguous array");
  }
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(orb::Descriptor) == 0) {
    span_ = {static_cast<const orb::Descriptor*>(bytes.data()), count};
    return;
  }
  copy_.resize(count);
  std::memcpy(copy_.data(), bytes.data(), count * kSize);
  span_ = copy_;
}

}  // namespace corvo::python
