// SPDX-License-Identifier: MIT
#include "orb/lsh_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <hwy/cache_control.h>

#include "orb/error.h"
#include "orb/kernels/distances_among.h"

namespace corvo::orb {
namespace {

constexpr int kMinAdded = 4096;   ///< Up to this many descriptors may be in no table.
constexpr int kAddedShare = 32;   ///< So may up to 1/kAddedShare of those in tables.
constexpr int kTablesAtOnce = 2;  ///< Tables probed between tests of whether to end.

/// Returns the next greater number with the same number of bits set (Gosper's hack).
std::uint32_t NextWithEqualBits(std::uint32_t bits) {
  const std::uint32_t lowest = bits & (0 - bits);
  const std::uint32_t carried = bits + lowest;
  return carried | (((bits ^ carried) / lowest) >> 2);
}

/// Throws corvo::Error if a number is out of its range.
struct CheckField {
  template <typename T>
  void operator()(std::string_view name, const T& value, T min, T max, std::string_view) const {
    CheckRange(name, value, min, max);
  }
};

}  // namespace

void LshIndexOptions::Validate() const { Visit(*this, CheckField{}); }

/// The state of one search.
class LshIndex::Search {
 public:
  Search(const LshIndex& index, const Descriptor& query, int k)
      : index_(index), query_(query), k_(k), num_tables_(static_cast<int>(index.tables_.size())) {
    for (int t = 0; t < num_tables_; ++t) keys_[t] = KeyOf(query, index.tables_[t].bits);
  }

  std::vector<Neighbor> Run() {
    CompareAdded();
    const int max_flips = std::min(index_.options_.max_flips, index_.bits_a_key());
    for (int flips = 0; flips <= max_flips; ++flips) {
      const int step = flips == 0 ? num_tables_ : kTablesAtOnce;
      for (int first = 0; first < num_tables_; first += step) {
        const int end = std::min(first + step, num_tables_);
        for (int t = first; t < end; ++t) ProbeTable(t, flips);
        VisitBuckets();
        Compare();
        if (FarthestKept() <= index_.SureDistance(flips, end)) return nearest_;
      }
    }
    return nearest_;
  }

 private:
  struct Bucket {
    int table = 0;
    std::uint32_t key = 0;
  };
  static constexpr int kMaxBuckets = 256;      ///< Buckets being prefetched.
  static constexpr int kMaxCandidates = 1024;  ///< Descriptors compared at once.

  /// Returns the largest distance at which a descriptor can still be kept.
  int FarthestKept() const {
    return static_cast<int>(nearest_.size()) < k_ ? Neighbor().distance : nearest_.back().distance;
  }

  /// Compares the descriptors that are in no table.
  void CompareAdded() {
    for (int i = index_.num_in_tables_; i < index_.size(); ++i) {
      AddCandidate(static_cast<std::uint32_t>(i));
    }
    Compare();
  }

  /// Probes the buckets whose keys differ from the query's in `flips` bits.
  void ProbeTable(int table, int flips) {
    const std::uint32_t end = std::uint32_t{1} << index_.bits_a_key();
    std::uint32_t flipped = (std::uint32_t{1} << flips) - 1;
    if (flipped == 0) return Probe(table, keys_[table]);
    for (; flipped < end; flipped = NextWithEqualBits(flipped)) {
      Probe(table, keys_[table] ^ flipped);
    }
  }

  void Probe(int table, std::uint32_t key) {
    if (num_buckets_ == kMaxBuckets) VisitBuckets();
    hwy::Prefetch(&index_.tables_[table].starts[key]);
    buckets_[num_buckets_++] = {table, key};
  }

  /// Adds the descriptors in the probed buckets to the candidates.
  void VisitBuckets() {
    for (int i = 0; i < num_buckets_; ++i) {
      const Table& table = index_.tables_[buckets_[i].table];
      hwy::Prefetch(table.ids.data() + table.starts[buckets_[i].key]);
    }
    for (int i = 0; i < num_buckets_; ++i) {
      const Table& table = index_.tables_[buckets_[i].table];
      const std::uint32_t end = table.starts[buckets_[i].key + 1];
      for (std::uint32_t j = table.starts[buckets_[i].key]; j < end; ++j) {
        AddCandidate(table.ids[j]);
      }
    }
    num_buckets_ = 0;
  }

  void AddCandidate(std::uint32_t id) {
    if (num_candidates_ == kMaxCandidates) Compare();
    candidates_[num_candidates_++] = id;
  }

  /// Compares the candidates with the query, and keeps the nearest.
  void Compare() {
    kernels::FindDistancesAmong(query_, index_.descriptors_.data(), candidates_.data(),
                                num_candidates_, distances_.data());
    for (int i = 0; i < num_candidates_; ++i) {
      if (distances_[i] > FarthestKept()) continue;
      Keep({distances_[i], static_cast<int>(candidates_[i])});
    }
    num_candidates_ = 0;
  }

  /// Inserts a neighbor, unless it was already found in another table.
  void Keep(const Neighbor& neighbor) {
    const auto place = std::lower_bound(nearest_.begin(), nearest_.end(), neighbor);
    if (place != nearest_.end() && *place == neighbor) return;
    nearest_.insert(place, neighbor);
    if (static_cast<int>(nearest_.size()) > k_) nearest_.pop_back();
  }

  const LshIndex& index_;
  const Descriptor& query_;
  int k_;
  int num_tables_;
  std::array<std::uint32_t, 12> keys_;
  std::array<Bucket, kMaxBuckets> buckets_;
  int num_buckets_ = 0;
  std::array<std::uint32_t, kMaxCandidates> candidates_;
  std::array<std::uint16_t, kMaxCandidates> distances_;
  int num_candidates_ = 0;
  std::vector<Neighbor> nearest_;
};

LshIndex::LshIndex(const LshIndexOptions& options) : options_(options) { options_.Validate(); }

LshIndex::LshIndex(std::span<const Descriptor> descriptors, const LshIndexOptions& options)
    : LshIndex(options) {
  Add(descriptors);
}

void LshIndex::Add(std::span<const Descriptor> descriptors) {
  const std::size_t needed = descriptors_.size() + descriptors.size();
  CheckRange<std::size_t>("descriptors of an index", needed, 0, 0x7fffffff);
  if (needed > descriptors_.capacity()) {
    descriptors_.reserve(std::max(needed, descriptors_.size() + descriptors_.size() / 8));
  }
  descriptors_.insert(descriptors_.end(), descriptors.begin(), descriptors.end());
  const int allowed = std::max(kMinAdded, num_in_tables_ / kAddedShare);
  if (size() - num_in_tables_ <= allowed) return;
  tables_.clear();
  MakeTables(ChooseKeyBits(descriptors_, options_.num_tables, BitsAKey(descriptors_.size())),
             size());
}

void LshIndex::MakeTables(const std::vector<KeyBits>& keys, int num_in_tables) {
  num_in_tables_ = num_in_tables;
  tables_.assign(keys.size(), {});
  for (std::size_t t = 0; t < keys.size(); ++t) {
    tables_[t].bits = keys[t];
    FillTable(tables_[t]);
  }
  PlanSearches();
}

void LshIndex::FillTable(Table& table) const {
  std::vector<std::uint32_t> keys(num_in_tables_);
  table.starts.assign((std::size_t{1} << table.bits.size()) + 1, 0);
  for (int i = 0; i < num_in_tables_; ++i) {
    keys[i] = KeyOf(descriptors_[i], table.bits);
    ++table.starts[keys[i] + 1];
  }
  std::partial_sum(table.starts.begin(), table.starts.end(), table.starts.begin());
  std::vector<std::uint32_t> next(table.starts.begin(), table.starts.end() - 1);
  table.ids.resize(num_in_tables_);
  for (int i = 0; i < num_in_tables_; ++i) {
    table.ids[next[keys[i]]++] = static_cast<std::uint32_t>(i);
  }
}

void LshIndex::PlanSearches() {
  const double allowed = 1 - options_.recall;
  const int num_tables = options_.num_tables;
  sure_distances_.clear();
  for (int flips = 0; flips <= options_.max_flips; ++flips) {
    for (int tables = 1; tables <= num_tables; ++tables) {
      const auto miss = [&](int distance) {
        const double now = ChanceOfFlips(distance, bits_a_key(), flips);
        const double before = ChanceOfFlips(distance, bits_a_key(), flips - 1);
        return std::pow(1 - now, tables) * std::pow(1 - before, num_tables - tables);
      };
      int sure = -1;
      while (sure < 256 && miss(sure + 1) <= allowed) ++sure;
      sure_distances_.push_back(sure);
    }
  }
}

int LshIndex::SureDistance(int flips, int tables) const {
  return sure_distances_[flips * options_.num_tables + tables - 1];
}

std::vector<Neighbor> LshIndex::FindNearest(const Descriptor& query, int k) const {
  if (k < 1) throw Error("k is " + std::to_string(k) + "; allowed is 1 or more");
  return Search(*this, query, k).Run();
}

std::size_t LshIndex::memory_bytes() const {
  std::size_t bytes = descriptors_.capacity() * sizeof(Descriptor);
  for (const Table& table : tables_) {
    bytes += (table.starts.capacity() + table.ids.capacity()) * sizeof(std::uint32_t);
  }
  return bytes;
}

}  // namespace corvo::orb
