// SPDX-License-Identifier: MIT
#include "orb/apportion.h"

#include <algorithm>
#include <bit>

namespace corvo::orb {
namespace {

/// A set of shares; bit i stands for share i.
using Set = std::uint64_t;

/// Calls `visit(i)` for the members of `set`, in ascending order.
template <typename Visit>
void ForEach(Set set, const Visit& visit) {
  for (; set != 0; set &= set - 1) visit(std::countr_zero(set));
}

/// The proportional division of the remaining total among the open shares.
struct Division {
  std::span<const std::int64_t> weights;
  std::int64_t left;
  std::int64_t weight_sum = 0;

  void Sum(Set open) {
    weight_sum = 0;
    ForEach(open, [&](int i) { weight_sum += std::max<std::int64_t>(weights[i], 1); });
  }
  std::int64_t Share(int i) const { return left * weights[i] / weight_sum; }
  std::int64_t Remainder(int i) const { return left * weights[i] % weight_sum; }
};

/// Returns the open share with the largest remainder.
int FindNeediest(const Division& division, Set open) {
  int neediest = std::countr_zero(open);
  ForEach(open, [&](int i) {
    if (division.Remainder(i) > division.Remainder(neediest)) neediest = i;
  });
  return neediest;
}

}  // namespace

void Apportion(int total, std::span<const std::int64_t> weights, std::span<const int> capacities,
               std::span<int> shares) {
  Division division{weights, total};
  Set open = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) open |= Set{1} << i;
  for (Set full = open; full != 0;) {
    division.Sum(open);
    full = 0;
    ForEach(open, [&](int i) {
      if (division.Share(i) >= capacities[i]) full |= Set{1} << i;
    });
    ForEach(full, [&](int i) { division.left -= shares[i] = capacities[i]; });
    open &= ~full;
  }
  std::int64_t rest = open == 0 ? 0 : division.left;
  ForEach(open, [&](int i) { rest -= shares[i] = static_cast<int>(division.Share(i)); });
  for (; rest > 0; --rest) {
    const int i = FindNeediest(division, open);
    ++shares[i];
    open &= ~(Set{1} << i);
  }
}

}  // namespace corvo::orb
