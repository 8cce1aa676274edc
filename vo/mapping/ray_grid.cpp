// SPDX-License-Identifier: MIT
#include "vo/mapping/ray_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "vo/math/chi_square.h"

namespace corvo {
namespace {

template <typename T>
void Reorder(const std::vector<int>& order, std::vector<T>& values) {
  std::vector<T> reordered(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) reordered[i] = values[order[i]];
  values = std::move(reordered);
}

}  // namespace

UnmatchedKeypoints CollectUnmatched(const Frame& frame, const MeasurementModel& model) {
  UnmatchedKeypoints unmatched;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] != kNoId) continue;
    const double sigma = model.Sigma(frame, k) / model.camera.FocalAt(frame.rays[k]);
    unmatched.index.push_back(k);
    unmatched.descriptors.push_back(frame.descriptor(k));
    unmatched.x.push_back(frame.rays[k].x());
    unmatched.y.push_back(frame.rays[k].y());
    unmatched.variances.push_back(sigma * sigma);
    unmatched.octave_scales.push_back(model.Scale(frame, k));
  }
  return unmatched;
}

RayGrid::RayGrid(UnmatchedKeypoints points, double cell_size)
    : points_(std::move(points)), cell_size_(cell_size), cells_per_unit_(1 / cell_size) {
  if (points_.size() == 0) return;
  const auto [left, right] = std::minmax_element(points_.x.begin(), points_.x.end());
  const auto [top, bottom] = std::minmax_element(points_.y.begin(), points_.y.end());
  origin_ = {*left, *top};
  columns_ = static_cast<int>((*right - *left) / cell_size_) + 1;
  rows_ = static_cast<int>((*bottom - *top) / cell_size_) + 1;
  SortIntoCells();
  for (const double variance : points_.variances) {
    max_squared_distances_.push_back(kChiSquare1Dof95 * variance);
  }
  margin_ =
      std::sqrt(*std::max_element(max_squared_distances_.begin(), max_squared_distances_.end()));
}

std::span<int> RayGrid::Find(const EpipolarSegment& segment, std::vector<int>& buffer) const {
  if (columns_ == 0) return {};
  const double top = std::min(segment.near.y(), segment.far.y());
  const double bottom = std::max(segment.near.y(), segment.far.y());
  const Eigen::Vector2d along = segment.far - segment.near;
  const bool is_level = std::abs(along.y()) < 1e-12;
  const double slope = is_level ? 0 : along.x() / along.y();
  const auto x_at = [&](double y) {
    return segment.near.x() + slope * (std::clamp(y, top, bottom) - segment.near.y());
  };
  int count = 0;
  const int last_row = RowOf(bottom + margin_);
  for (int row = RowOf(top - margin_); row <= last_row; ++row) {
    const double row_top = origin_.y() + row * cell_size_;
    const double x = x_at(row_top - margin_);
    const double other_x = is_level ? segment.far.x() : x_at(row_top + cell_size_ + margin_);
    const int* starts = starts_.data() + static_cast<std::ptrdiff_t>(row) * columns_;
    const int begin = starts[ColumnOf(std::min(x, other_x) - margin_)];
    const int end = starts[ColumnOf(std::max(x, other_x) + margin_) + 1];
    count = AppendNear(segment.line, begin, end, buffer, count);
  }
  return std::span<int>(buffer).first(count);
}

int RayGrid::CellOf(double offset, int count) const {
  return static_cast<int>(std::clamp(offset * cells_per_unit_, 0.0, count - 1.0));
}

void RayGrid::SortIntoCells() {
  const int num_points = points_.size();
  const auto cell_of = [&](int i) {
    return RowOf(points_.y[i]) * columns_ + ColumnOf(points_.x[i]);
  };
  starts_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (int i = 0; i < num_points; ++i) ++starts_[cell_of(i) + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<int> next = starts_;
  std::vector<int> order(num_points);
  for (int i = 0; i < num_points; ++i) order[next[cell_of(i)]++] = i;
  Reorder(order, points_.index);
  Reorder(order, points_.descriptors);
  Reorder(order, points_.x);
  Reorder(order, points_.y);
  Reorder(order, points_.variances);
  Reorder(order, points_.octave_scales);
}

int RayGrid::AppendNear(const Eigen::Vector3d& line, int begin, int end, std::vector<int>& buffer,
                        int count) const {
  const double squared_norm = line.head<2>().squaredNorm();
  for (int i = begin; i < end; ++i) {
    const double distance = line.x() * points_.x[i] + line.y() * points_.y[i] + line.z();
    buffer[count] = i;  // The entry stays if the point is near, and is overwritten otherwise.
    count += distance * distance <= max_squared_distances_[i] * squared_norm;
  }
  return count;
}

}  // namespace corvo
