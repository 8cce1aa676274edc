// SPDX-License-Identifier: MIT
#include "orb/keypoint_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "orb/error.h"
#include "orb/kernels/disc_search.h"

namespace corvo::orb {
namespace {

constexpr int kMaxCellsPerSide = 256;

void CheckFinite(std::span<const Keypoint> keypoints) {
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    if (std::isfinite(keypoints[i].x) && std::isfinite(keypoints[i].y)) continue;
    throw Error("keypoint " + std::to_string(i) + " is not at finite coordinates");
  }
}

/// Returns the index of the cell that contains `position`, in units of cells, clamped to [0,
/// count).
int CellAt(double position, int count) {
  return static_cast<int>(std::clamp(position, 0.0, count - 1.0));
}

}  // namespace

KeypointIndex::KeypointIndex(std::span<const Keypoint> keypoints, float cell_size_px) {
  CheckFinite(keypoints);
  if (!(cell_size_px > 0)) throw Error("cell_size_px must be positive");
  if (keypoints.empty()) return;
  LayOut(keypoints, cell_size_px);
  SortIntoCells(keypoints);
}

void KeypointIndex::SortIntoCells(std::span<const Keypoint> keypoints) {
  const auto cell_of = [&](const Keypoint& k) { return RowOf(k.y) * columns_ + ColumnOf(k.x); };
  cell_starts_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (const Keypoint& keypoint : keypoints) ++cell_starts_[cell_of(keypoint) + 1];
  std::partial_sum(cell_starts_.begin(), cell_starts_.end(), cell_starts_.begin());
  std::vector<int> next = cell_starts_;
  const std::size_t padded_size = keypoints.size() + kernels::kGridPadding;
  x_.resize(padded_size);
  y_.resize(padded_size);
  octaves_.resize(padded_size);
  indices_.resize(padded_size);
  for (int i = 0; i < size(); ++i) {
    const int to = next[cell_of(keypoints[i])]++;
    x_[to] = keypoints[i].x;
    y_[to] = keypoints[i].y;
    octaves_[to] = keypoints[i].octave;
    indices_[to] = i;
  }
}

void KeypointIndex::LayOut(std::span<const Keypoint> keypoints, double cell_size_px) {
  const auto [min_x, max_x] = std::minmax_element(keypoints.begin(), keypoints.end(),
                                                  [](auto& a, auto& b) { return a.x < b.x; });
  const auto [min_y, max_y] = std::minmax_element(keypoints.begin(), keypoints.end(),
                                                  [](auto& a, auto& b) { return a.y < b.y; });
  left_ = min_x->x;
  top_ = min_y->y;
  const double width = max_x->x - left_;
  const double height = max_y->y - top_;
  cells_per_px_ = 1 / std::max({cell_size_px, width / kMaxCellsPerSide, height / kMaxCellsPerSide});
  columns_ = static_cast<int>(width * cells_per_px_) + 1;
  rows_ = static_cast<int>(height * cells_per_px_) + 1;
}

int KeypointIndex::ColumnOf(double x) const {
  return CellAt((x - left_) * cells_per_px_, columns_);
}

int KeypointIndex::RowOf(double y) const { return CellAt((y - top_) * cells_per_px_, rows_); }

void KeypointIndex::Find(const SearchWindow& window, std::vector<int>& found) const {
  const auto first_found = static_cast<std::ptrdiff_t>(found.size());
  FindUnordered(window, found);
  std::sort(found.begin() + first_found, found.end());
}

void KeypointIndex::FindUnordered(const SearchWindow& window, std::vector<int>& found) const {
  const auto& [x, y, radius, min_octave, max_octave] = window;
  if (size() == 0 || !(radius >= 0) || !std::isfinite(x) || !std::isfinite(y)) return;
  const kernels::OctaveDisc disc = {x, y, radius, min_octave, max_octave};
  const kernels::CellRange cells = {ColumnOf(disc.x - disc.radius), ColumnOf(disc.x + disc.radius),
                                    RowOf(disc.y - disc.radius), RowOf(disc.y + disc.radius)};
  std::size_t room = kernels::kGridPadding;
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    const int* starts = cell_starts_.data() + row * columns_;
    room += starts[cells.last_column + 1] - starts[cells.first_column];
  }
  const std::size_t num_before = found.size();
  found.resize(num_before + room);
  const int num_found = kernels::FindInDisc(
      {x_.data(), y_.data(), octaves_.data(), indices_.data(), cell_starts_.data(), columns_},
      cells, disc, found.data() + num_before);
  found.resize(num_before + num_found);
}

}  // namespace corvo::orb
