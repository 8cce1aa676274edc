// SPDX-License-Identifier: MIT
#include "orb/grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

namespace corvo::orb {
namespace {

CornerRank RankOf(const Corner& corner, std::size_t index) {
  return std::uint64_t{static_cast<std::uint32_t>(corner.score)} << 32 |
         static_cast<std::uint32_t>(~index);
}

int IndexOf(CornerRank rank) { return static_cast<int>(~static_cast<std::uint32_t>(rank)); }

/// Returns the `kCount` highest of at least as many ranks, in descending order.
template <std::size_t kCount>
std::array<CornerRank, kCount> Highest(std::span<const CornerRank> ranks) {
  std::array<CornerRank, kCount> highest{};
  for (CornerRank rank : ranks) {
    for (CornerRank& place : highest) {  // Without branches, which would be unpredictable.
      const CornerRank higher = std::max(place, rank);
      rank = std::min(place, rank);
      place = higher;
    }
  }
  return highest;
}

/// Sets the first `count` elements to the best ranks, in descending order; the other ranks may be
/// lost.
void PutBestFirst(std::span<CornerRank> ranks, std::ptrdiff_t count) {
  const auto put = [&](const auto& best) { std::copy_n(best.begin(), count, ranks.begin()); };
  if (count == 1) return put(Highest<1>(ranks));
  if (count == 2) return put(Highest<2>(ranks));
  if (count <= 4) return put(Highest<4>(ranks));
  std::partial_sort(ranks.begin(), ranks.begin() + count, ranks.end(), std::greater<>());
}

/// Returns the number of cells of about `cell_size` into which a length is divided.
int NumCells(int length, int cell_size) {
  return std::max(1, (length + cell_size / 2) / cell_size);
}

}  // namespace

void GridSelector::FindCells(std::span<const Corner> corners, const cv::Rect& area, int cell_size) {
  const int columns = NumCells(area.width, cell_size);
  const int rows = NumCells(area.height, cell_size);
  column_of_x_.resize(area.width);
  for (int i = 0; i < area.width; ++i) {
    column_of_x_[i] = static_cast<int>(std::int64_t{i} * columns / area.width);
  }
  cell_ends_.assign(static_cast<std::size_t>(columns) * rows, 0);
  cell_of_.resize(corners.size());
  int y = -1;
  int row_start = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i].y != y) {
      y = corners[i].y;
      row_start = static_cast<int>(std::int64_t{y - area.y} * rows / area.height) * columns;
    }
    cell_of_[i] = row_start + column_of_x_[corners[i].x - area.x];
    ++cell_ends_[cell_of_[i]];
  }
}

void GridSelector::FindBest(std::span<const Corner> corners) {
  best_.assign(cell_ends_.size(), 0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    best_[cell_of_[i]] = std::max(best_[cell_of_[i]], RankOf(corners[i], i));
  }
  std::copy_if(best_.begin(), best_.end(), std::back_inserter(next_), std::identity());
}

void GridSelector::GroupByCell(std::span<const Corner> corners) {
  std::exclusive_scan(cell_ends_.begin(), cell_ends_.end(), cell_ends_.begin(), 0);
  members_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    members_[cell_ends_[cell_of_[i]]++] = RankOf(corners[i], i);
  }
}

int GridSelector::FullRounds(int quota) {
  cells_with_more_.clear();
  int begin = 0;
  for (const int end : cell_ends_) {  // Histogram of cell sizes, then its suffix sums.
    const std::size_t size = end - std::exchange(begin, end);
    if (size == 0) continue;
    if (cells_with_more_.size() < size) cells_with_more_.resize(size, 0);
    ++cells_with_more_[size - 1];
  }
  std::partial_sum(cells_with_more_.rbegin(), cells_with_more_.rend(), cells_with_more_.rbegin());
  int rounds = 0;
  int taken = 0;
  for (const int cells : cells_with_more_) {
    if (taken + cells > quota) break;
    taken += cells;
    ++rounds;
  }
  return rounds;
}

void GridSelector::TakeRounds(int rounds, std::vector<int>& chosen) {
  auto begin = members_.begin();
  for (const int cell_end : cell_ends_) {
    const auto end = members_.begin() + cell_end;
    const auto count = std::min<std::ptrdiff_t>(rounds, end - begin);
    if (count < end - begin) {
      PutBestFirst({begin, end}, count + 1);
      next_.push_back(begin[count]);
    }
    std::transform(begin, begin + count, std::back_inserter(chosen), IndexOf);
    begin = end;
  }
}

void GridSelector::TakeNext(int count, std::vector<int>& chosen) {
  const auto end = next_.begin() + std::min<std::ptrdiff_t>(count, std::ssize(next_));
  std::nth_element(next_.begin(), end, next_.end(), std::greater<>());
  std::transform(next_.begin(), end, std::back_inserter(chosen), IndexOf);
}

void GridSelector::Sort(std::size_t num_corners, std::vector<int>& chosen) {
  constexpr int kBits = 64;
  is_chosen_.assign(num_corners / kBits + 1, 0);
  for (const int i : chosen) is_chosen_[i / kBits] |= std::uint64_t{1} << (i % kBits);
  auto next = chosen.begin();
  for (std::size_t word = 0; word < is_chosen_.size(); ++word) {
    for (std::uint64_t bits = is_chosen_[word]; bits != 0; bits &= bits - 1) {
      *next++ = static_cast<int>(word) * kBits + std::countr_zero(bits);
    }
  }
}

void GridSelector::Select(std::span<const Corner> corners, const cv::Rect& area, int cell_size,
                          int quota, std::vector<int>& chosen) {
  chosen.clear();
  if (quota <= 0 || corners.empty()) return;
  FindCells(corners, area, cell_size);
  const auto num_empty = std::count(cell_ends_.begin(), cell_ends_.end(), 0);
  next_.clear();
  if (std::ssize(cell_ends_) - num_empty > quota) {
    FindBest(corners);
  } else {  // The quota allows at least one round of all cells.
    GroupByCell(corners);
    TakeRounds(FullRounds(quota), chosen);
  }
  TakeNext(quota - static_cast<int>(chosen.size()), chosen);
  Sort(corners.size(), chosen);
}

std::vector<int> SelectInGrid(std::span<const Corner> corners, const cv::Rect& area, int cell_size,
                              int quota) {
  std::vector<int> chosen;
  GridSelector().Select(corners, area, cell_size, quota, chosen);
  return chosen;
}

void SelectStrongest(std::span<const Corner> corners, int quota, std::vector<int>& chosen) {
  chosen.resize(corners.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  const auto count = std::min(chosen.size(), static_cast<std::size_t>(std::max(quota, 0)));
  const auto end = chosen.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(chosen.begin(), end, chosen.end(),
                   [&](int a, int b) { return RankOf(corners[a], a) > RankOf(corners[b], b); });
  chosen.resize(count);
  std::sort(chosen.begin(), chosen.end());
}

}  // namespace corvo::orb
