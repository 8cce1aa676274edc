// SPDX-License-Identifier: MIT
#include "orb/lsh_keys.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace corvo::orb {
namespace {

constexpr int kNumBits = 256;
constexpr std::size_t kMaxSample = 16384;

/// The values of each bit over a sample of descriptors, and their statistics.
class BitStatistics {
 public:
  explicit BitStatistics(std::span<const Descriptor> descriptors)
      : size_(std::min(descriptors.size(), kMaxSample)), words_((size_ + 63) / 64) {
    columns_.assign(kNumBits * words_, 0);
    for (std::size_t i = 0; i < size_; ++i) {
      Append(descriptors[i * descriptors.size() / size_], i);
    }
    for (int bit = 0; bit < kNumBits; ++bit) ones_.push_back(CountBoth(bit, bit));
  }

  /// Returns (2 m - 1)^2, where m is the mean of the bit.
  double Imbalance(int bit) const {
    if (size_ == 0) return 1;
    const double excess = 2 * ones_[bit] / static_cast<double>(size_) - 1;
    return excess * excess;
  }

  /// Returns the squared correlation of two bits, 0 to 1; it is 1 if either is constant.
  double SquaredCorrelation(int a, int b) const {
    const auto n = static_cast<double>(size_);
    const double covariance = n * CountBoth(a, b) - ones_[a] * ones_[b];
    const double variances = ones_[a] * (n - ones_[a]) * ones_[b] * (n - ones_[b]);
    return variances > 0 ? covariance * covariance / variances : 1;
  }

 private:
  void Append(const Descriptor& descriptor, std::size_t i) {
    for (int bit = 0; bit < kNumBits; ++bit) {
      const std::uint64_t value = descriptor.bytes[bit / 8] >> (bit % 8) & 1;
      columns_[bit * words_ + i / 64] |= value << (i % 64);
    }
  }

  /// Returns the number of descriptors with both bits set.
  double CountBoth(int a, int b) const {
    int count = 0;
    for (std::size_t i = 0; i < words_; ++i) {
      count += std::popcount(columns_[a * words_ + i] & columns_[b * words_ + i]);
    }
    return count;
  }

  std::size_t size_;
  std::size_t words_;
  std::vector<std::uint64_t> columns_;
  std::vector<double> ones_;
};

/// The bits that are in no key, and the cost of adding each to each key.
class FreeBits {
 public:
  FreeBits(const BitStatistics& statistics, int num_keys) : statistics_(statistics) {
    std::vector<double> cost;
    for (int bit = 0; bit < kNumBits; ++bit) cost.push_back(statistics.Imbalance(bit));
    costs_.assign(num_keys, cost);
  }

  /// Adds the free bit of least cost to a key.
  int Take(int key) {
    std::vector<double>& cost = costs_[key];
    const int taken = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    for (int bit = 0; bit < kNumBits; ++bit) {
      cost[bit] += statistics_.SquaredCorrelation(taken, bit);
    }
    for (std::vector<double>& other : costs_) other[taken] = kTaken;
    return taken;
  }

 private:
  static constexpr double kTaken = std::numeric_limits<double>::infinity();
  const BitStatistics& statistics_;
  std::vector<std::vector<double>> costs_;
};

}  // namespace

std::uint32_t KeyOf(const Descriptor& descriptor, const KeyBits& bits) {
  std::uint32_t key = 0;
  for (std::size_t j = 0; j < bits.size(); ++j) {
    const std::uint32_t value = descriptor.bytes[bits[j] / 8] >> (bits[j] % 8) & 1;
    key |= value << j;
  }
  return key;
}

int BitsAKey(std::size_t num_descriptors) {
  constexpr int kMinBits = 8, kMaxBits = 21;
  return std::clamp(static_cast<int>(std::bit_width(num_descriptors)) - 3, kMinBits, kMaxBits);
}

std::vector<KeyBits> ChooseKeyBits(std::span<const Descriptor> descriptors, int num_tables,
                                   int bits_a_key) {
  const BitStatistics statistics(descriptors);
  FreeBits free_bits(statistics, num_tables);
  std::vector<KeyBits> keys(num_tables);
  for (int j = 0; j < bits_a_key; ++j) {
    for (int key = 0; key < num_tables; ++key) {
      keys[key].push_back(static_cast<std::uint8_t>(free_bits.Take(key)));
    }
  }
  for (KeyBits& bits : keys) std::sort(bits.begin(), bits.end());
  return keys;
}

double ChanceOfFlips(int distance, int bits_a_key, int max_flips) {
  // chance[f] is the probability that f of the bits drawn one after the other differ.
  std::vector<double> chance(bits_a_key + 1, 0.0);
  chance[0] = 1;
  for (int drawn = 0; drawn < bits_a_key; ++drawn) {
    const double left = kNumBits - drawn;
    for (int f = drawn + 1; f >= 0; --f) {
      const double same = std::max(0, kNumBits - distance - (drawn - f)) / left;
      const double more = f > 0 ? chance[f - 1] * std::max(0, distance - (f - 1)) / left : 0;
      chance[f] = chance[f] * same + more;
    }
  }
  double sum = 0;
  for (int f = 0; f <= std::min(max_flips, bits_a_key); ++f) sum += chance[f];
  return max_flips >= std::min(distance, bits_a_key) ? 1 : std::min(sum, 1.0);
}

}  // namespace corvo::orb
