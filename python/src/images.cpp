// SPDX-License-Identifier: MIT
#include "python/src/images.h"

#include <cstdint>
#include <memory>
#include <string_view>

#include <opencv2/imgproc.hpp>

#include "python/src/arrays.h"
#include "python/src/checked_arrays.h"

namespace corvo::python {
namespace {

namespace nb = nanobind;

constexpr std::size_t kMaxSide = 100000;
constexpr std::size_t kNumColors = 3;

bool HasSize(const CheckedArray& array) {
  const auto is_side = [](std::size_t side) { return side > 0 && side <= kMaxSide; };
  return is_side(array.shape(0)) && is_side(array.shape(1));
}

/// Returns whether the pixels of each row follow each other, and the rows do not overlap.
bool HasContiguousRows(const CheckedArray& array) {
  std::int64_t step = 1;
  for (std::size_t axis = array.ndim() - 1; axis > 0; --axis) {
    if (array.shape(axis) > 1 && array.stride(axis) != step) return false;
    step *= static_cast<std::int64_t>(array.shape(axis));
  }
  return array.shape(0) == 1 || array.stride(0) >= step;
}

/// Returns an image of `type` that shares the pixels of an array.
cv::Mat ToMat(nb::handle object, const CheckedArray& array, int type, std::string_view name) {
  if (!HasContiguousRows(array)) {
    ThrowNotAllowed(name, "strides", object.attr("strides"),
                    "contiguous rows, as numpy.ascontiguousarray makes them");
  }
  const int height = static_cast<int>(array.shape(0));
  const int width = static_cast<int>(array.shape(1));
  auto* const pixels = const_cast<void*>(array.data());  // cv::Mat has no constant variant.
  // The stride of a single row may be anything.
  if (height == 1) return cv::Mat(height, width, type, pixels);
  return cv::Mat(height, width, type, pixels, static_cast<std::size_t>(array.stride(0)));
}

/// Returns an array that shares the pixels of a gray image.
template <typename Pixel>
nb::object Share(const cv::Mat& image) {
  auto owned = std::make_unique<cv::Mat>(image);
  auto* const pixels = owned->ptr<Pixel>();
  const auto rows = static_cast<std::size_t>(image.rows);
  const auto columns = static_cast<std::size_t>(image.cols);
  const auto step = static_cast<std::int64_t>(image.step1());
  const nb::capsule owner(owned.release(),
                          [](void* kept) noexcept { delete static_cast<cv::Mat*>(kept); });
  return nb::cast(NumpyArray<Pixel, -1, -1>(pixels, {rows, columns}, owner, {step, 1}));
}

}  // namespace

cv::Mat ToGrayImage(nb::handle image) {
  const CheckedArray array = ToCheckedArray(image, "uint8", "image");
  const bool is_color = array.ndim() == 3 && array.shape(2) == kNumColors;
  if ((array.ndim() != 2 && !is_color) || !HasSize(array)) {
    ThrowNotAllowed(
        "image", "shape", image.attr("shape"),
        "(height, width) for gray or (height, width, 3) for RGB, with sides of 1 to 100000");
  }
  if (!is_color) return ToMat(image, array, CV_8UC1, "image");
  cv::Mat gray;
  cv::cvtColor(ToMat(image, array, CV_8UC3, "image"), gray, cv::COLOR_RGB2GRAY);
  return gray;
}

cv::Mat ToMask(nb::handle mask) {
  if (mask.is_none()) return {};
  const CheckedArray array = ToCheckedArray(mask, "uint8", "mask");
  if (array.ndim() != 2 || !HasSize(array)) {
    ThrowNotAllowed("mask", "shape", mask.attr("shape"),
                    "(height, width), with sides of 1 to 100000");
  }
  return ToMat(mask, array, CV_8UC1, "mask").clone();
}

nb::object ToArray(const cv::Mat& image) {
  if (image.empty()) return nb::none();
  return image.depth() == CV_8U ? Share<std::uint8_t>(image) : Share<std::uint16_t>(image);
}

}  // namespace corvo::python
