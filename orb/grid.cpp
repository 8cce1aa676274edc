#include "orb/grid.h"

#include <algorithm>
#include <numeric>

namespace corvo::orb {
namespace {

/// Orders indices of corners: strongest first, ties by index.
class StrongerThan {
 public:
  explicit StrongerThan(std::span<const RankedCorner> corners) : corners_(corners) {}

  bool operator()(int a, int b) const {
    const RankedCorner& first = corners_[a];
    const RankedCorner& second = corners_[b];
    if (first.strong != second.strong) return first.strong;
    if (first.strength != second.strength) return first.strength > second.strength;
    return a < b;
  }

 private:
  std::span<const RankedCorner> corners_;
};

using Cells = std::vector<std::vector<int>>;

/// The corners of each cell, strongest first.
Cells SortIntoCells(std::span<const RankedCorner> corners, const cv::Rect& area, int cell_size) {
  const int columns = std::max(1, (area.width + cell_size / 2) / cell_size);
  const int rows = std::max(1, (area.height + cell_size / 2) / cell_size);
  Cells cells(static_cast<std::size_t>(columns) * rows);
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
    const std::int64_t column = std::int64_t{corners[i].x - area.x} * columns / area.width;
    const std::int64_t row = std::int64_t{corners[i].y - area.y} * rows / area.height;
    cells[row * columns + column].push_back(i);
  }
  for (auto& cell : cells) std::sort(cell.begin(), cell.end(), StrongerThan(corners));
  return cells;
}

/// The largest k for which the k strongest of every cell are at most `quota` together; stops at
/// the fullest cell's count.
int FullRounds(const Cells& cells, int quota) {
  std::size_t fullest = 0;
  for (const auto& cell : cells) fullest = std::max(fullest, cell.size());
  std::vector<int> cells_with_more(fullest + 1, 0);  // cells that hold more than k corners
  for (const auto& cell : cells) {
    for (std::size_t k = 0; k < cell.size(); ++k) ++cells_with_more[k];
  }
  int rounds = 0;
  int taken = 0;
  while (rounds < static_cast<int>(fullest) && taken + cells_with_more[rounds] <= quota) {
    taken += cells_with_more[rounds++];
  }
  return rounds;
}

}  // namespace

std::vector<int> Apportion(int total, std::span<const std::int64_t> weights,
                           std::span<const int> capacities) {
  std::vector<int> shares(weights.size(), 0);
  std::vector<int> open(weights.size());
  std::iota(open.begin(), open.end(), 0);
  std::int64_t left = total;
  std::int64_t weight_sum = 0;
  const auto share_of = [&](int i) { return left * weights[i] / weight_sum; };
  for (bool settled = false; !settled && !open.empty();) {
    weight_sum = 0;
    for (const int i : open) weight_sum += std::max<std::int64_t>(weights[i], 1);
    const auto full = std::stable_partition(open.begin(), open.end(),
                                            [&](int i) { return share_of(i) < capacities[i]; });
    settled = full == open.end();
    for (auto i = full; i != open.end(); ++i) left -= shares[*i] = capacities[*i];
    open.erase(full, open.end());
  }
  if (open.empty()) return shares;
  std::int64_t rest = left;
  for (const int i : open) rest -= shares[i] = static_cast<int>(share_of(i));
  std::stable_sort(open.begin(), open.end(), [&](int a, int b) {
    return left * weights[a] % weight_sum > left * weights[b] % weight_sum;
  });
  for (std::int64_t k = 0; k < rest; ++k) ++shares[open[k]];
  return shares;
}

std::vector<int> SelectInGrid(std::span<const RankedCorner> corners, const cv::Rect& area,
                              int cell_size, int quota) {
  if (quota <= 0 || corners.empty()) return {};
  const Cells cells = SortIntoCells(corners, area, cell_size);
  const auto rounds = static_cast<std::size_t>(FullRounds(cells, quota));
  std::vector<int> chosen;
  std::vector<int> next;
  for (const auto& cell : cells) {
    const std::size_t count = std::min(rounds, cell.size());
    chosen.insert(chosen.end(), cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(count));
    if (cell.size() > rounds) next.push_back(cell[rounds]);
  }
  std::sort(next.begin(), next.end(), StrongerThan(corners));
  next.resize(std::min(next.size(), static_cast<std::size_t>(quota) - chosen.size()));
  chosen.insert(chosen.end(), next.begin(), next.end());
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<int> SelectStrongest(std::span<const RankedCorner> corners, int quota) {
  std::vector<int> chosen(corners.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  std::sort(chosen.begin(), chosen.end(), StrongerThan(corners));
  chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(std::max(quota, 0))));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace corvo::orb
