// SPDX-License-Identifier: MIT
#include "orb/kernels/nearest_two.h"

#include <algorithm>

#include "orb/hamming.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/nearest_two.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#include "orb/kernels/pair_distances-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::FindNearestTwo;
#else

// A chunk of train descriptors is searched row by row. Each lane keeps its two least keys: the
// distance, then the row's number within the chunk in kRowBits. kNone is above every key.

constexpr int kRowBits = 7;
constexpr std::uint16_t kNone = 0xffff;
static_assert(NearestTwoScratch::kChunk <= (1 << kRowBits) * 8);  // No row is shorter than 8.

void PackChunk(const Descriptor* train, int count, NearestTwoScratch& scratch) {
  const int size = BlockSize();
  for (int j = 0; j < count; ++j) {
    PackTrain(train[j], j % size, scratch.train + j / size * size * kPackedBytes);
  }
  for (int j = 0; j < NearestTwoScratch::kChunk; ++j) {
    scratch.rows[j] = j < count ? static_cast<std::uint16_t>(j / RowSize()) : kNone;
  }
}

/// The keys of a query's lanes: the least, then the second least.
HWY_INLINE std::uint16_t* KeysOf(int query, NearestTwoScratch& scratch) {
  return scratch.nearest + 2 * RowSize() * query;
}

HWY_INLINE void KeepLeast(V16 key, V16& least, V16& second) {
  second = hn::Min(second, hn::Max(least, key));
  least = hn::Min(least, key);
}

/// Takes the two rows of a block into account; `rows` holds their numbers, kNone where no
/// descriptor is.
HWY_INLINE void UpdateKeys(V16 low, V16 high, const std::uint16_t* HWY_RESTRICT rows,
                           std::uint16_t* HWY_RESTRICT keys) {
  const D16 d;
  V16 least = hn::Load(d, keys);
  V16 second = hn::Load(d, keys + RowSize());
  KeepLeast(hn::Or(hn::ShiftLeft<kRowBits>(low), hn::Load(d, rows)), least, second);
  KeepLeast(hn::Or(hn::ShiftLeft<kRowBits>(high), hn::Load(d, rows + RowSize())), least, second);
  hn::Store(least, d, keys);
  hn::Store(second, d, keys + RowSize());
}

/// Takes what a key followed by 16 bits of lane stands for into account.
void UpdateFromKey(std::uint32_t key, int first_index, Nearest& nearest) {
  if (key >> 16 == kNone) return;
  const int distance = static_cast<int>(key >> (16 + kRowBits));
  const int row = static_cast<int>(key >> 16) & ((1 << kRowBits) - 1);
  const int lane = static_cast<int>(key & 0xffff);
  Update(nearest, first_index + row * RowSize() + lane, distance);
}

/// Takes the two least of all lanes' keys into account. Between equal keys the lower lane, and so
/// the lower index, comes first.
void UpdateFromKeys(const std::uint16_t* keys, int first_index, Nearest& nearest) {
  const hn::Half<D16> d16;
  const hn::Repartition<std::uint32_t, D16> d32;
  const int half = RowSize() / 2;
  const auto with_lane = [&](const std::uint16_t* from, int lane) HWY_ATTR {
    const auto key = hn::PromoteTo(d32, hn::Load(d16, from + lane));
    return hn::Or(hn::ShiftLeft<16>(key), hn::Iota(d32, static_cast<std::uint32_t>(lane)));
  };
  const auto low = with_lane(keys, 0);
  const auto high = with_lane(keys, half);
  const auto least = hn::MinOfLanes(d32, hn::Min(low, high));
  const auto next_low = with_lane(keys + 2 * half, 0);
  const auto next_high = with_lane(keys + 2 * half, half);
  const auto second =
      hn::MinOfLanes(d32, hn::Min(hn::IfThenElse(hn::Eq(low, least), next_low, low),
                                  hn::IfThenElse(hn::Eq(high, least), next_high, high)));
  UpdateFromKey(hn::GetLane(least), first_index, nearest);
  UpdateFromKey(hn::GetLane(second), first_index, nearest);
}

/// Takes the chunk of `count` descriptors in `scratch` into account.
void SearchChunk(std::span<const Descriptor> queries, int first_index, int count,
                 NearestTwoScratch& scratch, Nearest* nearest) {
  const int num_queries = static_cast<int>(queries.size());
  auto* const pairs = reinterpret_cast<QueryPair*>(scratch.queries);
  for (int q = 0; q < num_queries; q += 2) {
    pairs[q / 2] = PackQueries(queries[q], queries[std::min(q + 1, num_queries - 1)]);
  }
  std::fill(std::begin(scratch.nearest), std::end(scratch.nearest), kNone);
  for (int j = 0; j < count; j += BlockSize()) {
    for (int q = 0; q < num_queries; q += 2) {
      V16 low_a, high_a, low_b, high_b;
      CountDifferences(pairs[q / 2], scratch.train + j * kPackedBytes, low_a, high_a, low_b,
                       high_b);
      UpdateKeys(low_a, high_a, scratch.rows + j, KeysOf(q, scratch));
      UpdateKeys(low_b, high_b, scratch.rows + j, KeysOf(q + 1, scratch));
    }
  }
  for (int q = 0; q < num_queries; ++q) {
    UpdateFromKeys(KeysOf(q, scratch), first_index, nearest[q]);
  }
}

void FindNearestTwo(std::span<const Descriptor> queries, std::span<const Descriptor> train,
                    NearestTwoScratch& scratch, Nearest* nearest) {
  constexpr int kChunk = NearestTwoScratch::kChunk;
  constexpr std::size_t kGroup = NearestTwoScratch::kGroup;
  const int num_train = static_cast<int>(train.size());
  for (int j = 0; j < num_train; j += kChunk) {
    const int count = std::min(kChunk, num_train - j);
    PackChunk(train.data() + j, count, scratch);
    for (std::size_t i = 0; i < queries.size(); i += kGroup) {
      const auto group = queries.subspan(i, std::min(kGroup, queries.size() - i));
      SearchChunk(group, j, count, scratch, nearest + i);
    }
  }
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FindNearestTwo);

void FindNearestTwo(std::span<const Descriptor> queries, std::span<const Descriptor> train,
                    NearestTwoScratch& scratch, Nearest* nearest) {
  HWY_DYNAMIC_DISPATCH(FindNearestTwo)(queries, train, scratch, nearest);
}

namespace scalar {

void FindNearestTwo(std::span<const Descriptor> queries, std::span<const Descriptor> train,
                    NearestTwoScratch& /*scratch*/, Nearest* nearest) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    for (std::size_t j = 0; j < train.size(); ++j) {
      Update(nearest[i], static_cast<int>(j), HammingDistance(queries[i], train[j]));
    }
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
