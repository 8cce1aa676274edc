#include "orb/keypoint_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "orb/error.h"

namespace corvo::orb {
namespace {

constexpr int kMaxCellsPerSide = 256;

void CheckFinite(std::span<const Keypoint> keypoints) {
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    if (std::isfinite(keypoints[i].x) && std::isfinite(keypoints[i].y)) continue;
    throw Error("keypoint " + std::to_string(i) + " is not at finite coordinates");
  }
}

/// Index of the cell that holds `offset`, clamped to those that exist.
int CellOf(double offset, double cell_size, int count) {
  return static_cast<int>(std::clamp(offset / cell_size, 0.0, count - 1.0));
}

}  // namespace

KeypointIndex::KeypointIndex(std::span<const Keypoint> keypoints, float cell_size_px) {
  CheckFinite(keypoints);
  if (!(cell_size_px > 0)) throw Error("cell_size_px must be positive");
  if (keypoints.empty()) return;
  LayOut(keypoints, cell_size_px);
  const auto cell_of = [&](const Keypoint& k) { return RowOf(k.y) * columns_ + ColumnOf(k.x); };
  cell_starts_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (const Keypoint& keypoint : keypoints) ++cell_starts_[cell_of(keypoint) + 1];
  std::partial_sum(cell_starts_.begin(), cell_starts_.end(), cell_starts_.begin());
  std::vector<int> next = cell_starts_;
  entries_.resize(keypoints.size());
  for (int i = 0; i < static_cast<int>(keypoints.size()); ++i) {
    const Keypoint& keypoint = keypoints[i];
    entries_[next[cell_of(keypoint)]++] = {keypoint.x, keypoint.y, keypoint.octave, i};
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
  cell_size_ = std::max({cell_size_px, width / kMaxCellsPerSide, height / kMaxCellsPerSide});
  columns_ = static_cast<int>(width / cell_size_) + 1;
  rows_ = static_cast<int>(height / cell_size_) + 1;
}

int KeypointIndex::ColumnOf(double x) const { return CellOf(x - left_, cell_size_, columns_); }

int KeypointIndex::RowOf(double y) const { return CellOf(y - top_, cell_size_, rows_); }

void KeypointIndex::Find(float x, float y, float radius, int min_octave, int max_octave,
                         std::vector<int>& found) const {
  if (entries_.empty() || !(radius >= 0) || !std::isfinite(x) || !std::isfinite(y)) return;
  const auto first_found = static_cast<std::ptrdiff_t>(found.size());
  const double reach = radius;
  const double square = reach * reach;
  const int first_column = ColumnOf(x - reach);
  const int last_column = ColumnOf(x + reach);
  const int last_row = RowOf(y + reach);
  for (int row = RowOf(y - reach); row <= last_row; ++row) {
    const int begin = cell_starts_[row * columns_ + first_column];
    const int end = cell_starts_[row * columns_ + last_column + 1];
    for (int i = begin; i < end; ++i) {
      const Entry& entry = entries_[i];
      if (entry.octave < min_octave || entry.octave > max_octave) continue;
      const double dx = static_cast<double>(entry.x) - x;
      const double dy = static_cast<double>(entry.y) - y;
      if (dx * dx + dy * dy <= square) found.push_back(entry.index);
    }
  }
  std::sort(found.begin() + first_found, found.end());
}

}  // namespace corvo::orb
