// SPDX-License-Identifier: MIT
#include "python/src/byte_arrays.h"

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

ByteArray ToByteArray(nb::handle object, std::string_view name) {
  if (!nb::hasattr(object, "dtype")) {
    ThrowNotAllowed(name, "type", object.type().attr("__name__"), "a NumPy array");
  }
  const nb::object dtype = object.attr("dtype");
  ByteArray array;
  if (!nb::str(dtype).equal(nb::str("uint8")) || !nb::try_cast(object, array, false)) {
    ThrowNotAllowed(name, "dtype", dtype, "uint8");
  }
  return array;
}

DescriptorView::DescriptorView(nb::handle array, std::string_view name) {
  const ByteArray bytes = ToByteArray(array, name);
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
