// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include <nanobind/ndarray.h>
#include <Eigen/Core>

#include "vo/lie/se3.h"

namespace corvo::python {

template <typename Scalar, nanobind::ssize_t... Shape>
using NumpyArray = nanobind::ndarray<nanobind::numpy, Scalar, nanobind::shape<Shape...>>;

using Ids = NumpyArray<std::int64_t, -1>;
using Numbers = NumpyArray<double, -1>;
using Points2 = NumpyArray<double, -1, 2>;
using Points3 = NumpyArray<double, -1, 3>;
using Poses = NumpyArray<double, -1, 4, 4>;

/// Returns a NumPy array of type `Array` that owns `values`, in row-major order.
template <typename Array>
Array MoveToArray(std::vector<typename Array::Scalar> values,
                  std::initializer_list<std::size_t> shape) {
  using Values = std::vector<typename Array::Scalar>;
  auto owned = std::make_unique<Values>(std::move(values));
  auto* const data = owned->data();
  const nanobind::capsule owner(owned.release(),
                                [](void* kept) noexcept { delete static_cast<Values*>(kept); });
  return Array(data, shape, owner);
}

/// Appends the 16 numbers of [R t; 0 1] in row-major order.
inline void AppendMatrix(const SE3& pose, std::vector<double>& values) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = pose.matrix();
  values.insert(values.end(), matrix.data(), matrix.data() + matrix.size());
}

}  // namespace corvo::python
