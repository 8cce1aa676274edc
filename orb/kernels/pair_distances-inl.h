// SPDX-License-Identifier: MIT
// Included once for every instruction set.
#if defined(CORVO_ORB_KERNELS_PAIR_DISTANCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CORVO_ORB_KERNELS_PAIR_DISTANCES_INL_H
#undef CORVO_ORB_KERNELS_PAIR_DISTANCES_INL_H
#else
#define CORVO_ORB_KERNELS_PAIR_DISTANCES_INL_H
#endif

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#include "orb/types.h"

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Hamming distances between a pair of queries and a block of train descriptors. A block is as many
// descriptors as a register has bytes. It is packed in planes, each of which holds a few bits of
// every descriptor. Distances are rows of 16-bit numbers, a register each: `low` of the block's
// first half, `high` of its second.

using D16 = hn::ScalableTag<std::uint16_t>;
using D8 = hn::Repartition<std::uint8_t, D16>;
using V16 = hn::Vec<D16>;
using V8 = hn::Vec<D8>;

/// Distances in a row.
HWY_INLINE int RowSize() { return static_cast<int>(hn::Lanes(D16())); }

/// Descriptors in a block.
HWY_INLINE int BlockSize() { return 2 * RowSize(); }

#if HWY_TARGET == HWY_AVX3_DL

// The bits of 16-bit words are counted by an instruction. Plane p holds word p.

constexpr int kPlanes = 16;
constexpr int kPackedBytes = 32;  ///< Of a block, for each descriptor.

using Words = std::array<std::uint16_t, kPlanes>;

/// The words of two queries, each twice: it takes 32 bits to be broadcast from memory.
struct QueryPair {
  std::array<std::uint32_t, kPlanes> a;
  std::array<std::uint32_t, kPlanes> b;
};

inline Words WordsOf(const Descriptor& descriptor) {
  Words words;
  std::memcpy(words.data(), descriptor.bytes.data(), sizeof(words));
  return words;
}

/// Packs a descriptor as number `i` of a block.
inline void PackTrain(const Descriptor& descriptor, int i, std::uint8_t* block) {
  const Words words = WordsOf(descriptor);
  for (int p = 0; p < kPlanes; ++p) {
    std::memcpy(block + 2 * (p * BlockSize() + i), &words[p], sizeof(words[p]));
  }
}

inline QueryPair PackQueries(const Descriptor& a, const Descriptor& b) {
  const Words words_a = WordsOf(a);
  const Words words_b = WordsOf(b);
  QueryPair pair;
  for (int p = 0; p < kPlanes; ++p) {
    pair.a[p] = words_a[p] * 0x10001U;
    pair.b[p] = words_b[p] * 0x10001U;
  }
  return pair;
}

HWY_INLINE void CountDifferences(const QueryPair& pair, const std::uint8_t* HWY_RESTRICT block,
                                 V16& low_a, V16& high_a, V16& low_b, V16& high_b) {
  const D16 d16;
  const D8 d8;
  const hn::Repartition<std::uint32_t, D16> d32;
  low_a = high_a = low_b = high_b = hn::Zero(d16);
  HWY_UNROLL(1)  // Else GCC sums in a tree, which takes more registers than there are.
  for (int p = 0; p < kPlanes; ++p) {
    const V16 low = hn::BitCast(d16, hn::Load(d8, block + 2 * p * BlockSize()));
    const V16 high = hn::BitCast(d16, hn::Load(d8, block + (2 * p + 1) * BlockSize()));
    const V16 a = hn::BitCast(d16, hn::Set(d32, pair.a[p]));
    const V16 b = hn::BitCast(d16, hn::Set(d32, pair.b[p]));
    low_a = hn::Add(low_a, hn::PopulationCount(hn::Xor(low, a)));
    high_a = hn::Add(high_a, hn::PopulationCount(hn::Xor(high, a)));
    low_b = hn::Add(low_b, hn::PopulationCount(hn::Xor(low, b)));
    high_b = hn::Add(high_b, hn::PopulationCount(hn::Xor(high, b)));
  }
}

#else

// How many of 4 bits differ is looked up, for both queries at once: tables hold bytes a + 16 b.
// Plane p holds bits 4p to 4p + 3, a byte each; descriptors of the block's two halves take turns.

constexpr int kPlanes = 64;
constexpr int kPackedBytes = 64;  ///< Of a block, for each descriptor.

using Table = std::array<std::uint8_t, 16>;

/// For each plane the table of two queries, by the bits of a train descriptor.
struct QueryPair {
  alignas(16) std::array<Table, kPlanes> tables;
};

/// The tables of every 4 bits of query a and, times 16, of query b.
alignas(16) constexpr std::array<Table, 256> kTables = [] {
  std::array<Table, 256> tables{};
  for (unsigned ab = 0; ab < 256; ++ab) {
    for (unsigned bits = 0; bits < 16; ++bits) {
      const int a = std::popcount((ab & 15) ^ bits);
      const int b = std::popcount((ab >> 4) ^ bits);
      tables[ab][bits] = static_cast<std::uint8_t>(a + 16 * b);
    }
  }
  return tables;
}();

/// Packs a descriptor as number `i` of a block.
inline void PackTrain(const Descriptor& descriptor, int i, std::uint8_t* block) {
  const int lane = i < RowSize() ? 2 * i : 2 * (i - RowSize()) + 1;
  for (int p = 0; p < kPlanes; p += 2) {
    const unsigned byte = descriptor.bytes[p / 2];
    block[p * BlockSize() + lane] = static_cast<std::uint8_t>(byte & 15);
    block[(p + 1) * BlockSize() + lane] = static_cast<std::uint8_t>(byte >> 4);
  }
}

inline QueryPair PackQueries(const Descriptor& a, const Descriptor& b) {
  QueryPair pair;
  for (int p = 0; p < kPlanes; p += 2) {
    const unsigned byte_a = a.bytes[p / 2];
    const unsigned byte_b = b.bytes[p / 2];
    pair.tables[p] = kTables[(byte_a & 0x0f) | (byte_b << 4 & 0xf0)];
    pair.tables[p + 1] = kTables[byte_a >> 4 | (byte_b & 0xf0)];
  }
  return pair;
}

HWY_INLINE V8 LookUp(const QueryPair& pair, const std::uint8_t* HWY_RESTRICT block, int p) {
  const D8 d8;
  const V8 table = hn::LoadDup128(d8, pair.tables[p].data());
  return hn::TableLookupBytes(table, hn::Load(d8, block + p * BlockSize()));
}

/// Adds the lower and the upper byte of every lane.
HWY_INLINE void AddBytes(V16 bytes, V16& low, V16& high) {
  low = hn::Add(low, hn::And(bytes, hn::Set(D16(), 0x00ff)));
  high = hn::Add(high, hn::ShiftRight<8>(bytes));
}

/// The bytes of three tables sum up to 12 + 16 * 12. Of 63 tables, sum_a holds the a, at most 252 a
/// byte. A lane of sum_b is low b + 16 high a + 256 high b modulo 2^16; without the high a it is
/// two bytes too.
HWY_INLINE void CountDifferences(const QueryPair& pair, const std::uint8_t* HWY_RESTRICT block,
                                 V16& low_a, V16& high_a, V16& low_b, V16& high_b) {
  const D16 d16;
  const V16 is_a = hn::Set(d16, 0x0f0f);
  V16 sum_a = hn::Zero(d16);
  V16 sum_b = hn::Zero(d16);
  for (int p = 0; p + 3 <= kPlanes; p += 3) {
    const V8 two = hn::Add(LookUp(pair, block, p), LookUp(pair, block, p + 1));
    const V16 three = hn::BitCast(d16, hn::Add(two, LookUp(pair, block, p + 2)));
    sum_a = hn::Add(sum_a, hn::And(three, is_a));
    sum_b = hn::Add(sum_b, hn::ShiftRight<4>(three));
  }
  sum_b = hn::Sub(sum_b, hn::ShiftLeft<4>(hn::ShiftRight<8>(sum_a)));
  const V16 last = hn::BitCast(d16, LookUp(pair, block, kPlanes - 1));
  low_a = high_a = low_b = high_b = hn::Zero(d16);
  AddBytes(sum_a, low_a, high_a);
  AddBytes(sum_b, low_b, high_b);
  AddBytes(hn::And(last, is_a), low_a, high_a);
  AddBytes(hn::And(hn::ShiftRight<4>(last), is_a), low_b, high_b);
}

#endif

}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
