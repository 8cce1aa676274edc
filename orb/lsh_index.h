// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <new>
#include <span>
#include <vector>

#include "orb/lsh_keys.h"
#include "orb/types.h"

namespace corvo::orb {

/// The options of LshIndex. `Visit` calls the visitor for every field, with its range and meaning.
struct LshIndexOptions {
  int num_tables = 8;
  int max_flips = 2;
  double recall = 0.8;

  /// Throws corvo::Error with the name of the first field that is out of range.
  void Validate() const;

  bool operator==(const LshIndexOptions&) const = default;

  template <typename Self, typename Visitor>
  static void Visit(Self& self, Visitor&& field) {
    field("num_tables", self.num_tables, 1, 12,
          "hash tables: each takes 4 bytes a descriptor, and one more as the set grows");
    field("max_flips", self.max_flips, 0, 21, "bits of a key that are flipped, at most");
    field("recall", self.recall, 0.0, 1.0,
          "a search ends once its k-th nearest would have been found with this probability; 1: "
          "it ends when nothing nearer can be left, or with max_flips");
  }
};

/// A descriptor of the set and its distance from a query.
struct Neighbor {
  int distance = 257;  ///< Bits.
  int index = -1;

  bool operator==(const Neighbor&) const = default;
  bool operator<(const Neighbor& other) const {
    return distance != other.distance ? distance < other.distance : index < other.index;
  }
};

/// Finds the nearest neighbors of a query among millions of descriptors, by multi-probe
/// locality-sensitive hashing (Lv et al., "Multi-probe LSH", VLDB 2007) over disjoint bits, like
/// multi-index hashing (Norouzi et al., "Fast search in Hamming space with multi-index hashing",
/// CVPR 2012), but over bits of low correlation. A search probes the query's bucket in every table,
/// then the buckets whose key differs in one bit, then in two, up to max_flips. All bits count as
/// equally likely to flip: once l of L tables have been probed with up to r flips, and the others
/// with r - 1, a descriptor at distance d has been found with probability
///
///     1 - (1 - p_r(d))^l (1 - p_{r - 1}(d))^{L - l},   p_r(d) = ChanceOfFlips(d, ., r).
///
/// If recall is 1 and max_flips is at least the number of bits in a key, the search is exact. The
/// same sequence of calls gives the same results. Searches may run concurrently, but not during
/// Add().
class LshIndex {
 public:
  /// Throws corvo::Error if the options are out of range.
  explicit LshIndex(const LshIndexOptions& options = {});
  explicit LshIndex(std::span<const Descriptor> descriptors, const LshIndexOptions& options = {});

  /// Appends descriptors; the first has index size(). The latest descriptors, at most 4096 or 1/32
  /// of those in the tables, whichever is more, are in no table and are compared with every query.
  void Add(std::span<const Descriptor> descriptors);

  /// Returns the k nearest descriptors found, nearest first, ties by lower index. There may be
  /// fewer than min(k, size()). Throws corvo::Error if k is less than 1.
  std::vector<Neighbor> FindNearest(const Descriptor& query, int k) const;

  /// Writes a file from which Load() restores an equal index. Throws corvo::Error if it cannot be
  /// written.
  void Save(const std::filesystem::path& file) const;

  /// Reads a file written by Save(). Throws corvo::Error if the file cannot be read, is of another
  /// version, or is damaged.
  static LshIndex Load(const std::filesystem::path& file);

  int size() const { return static_cast<int>(descriptors_.size()); }
  const Descriptor& descriptor(int index) const { return descriptors_[index]; }
  const LshIndexOptions& options() const { return options_; }
  /// Returns the number of bits in a key, or 0 if there are no tables.
  int bits_a_key() const { return tables_.empty() ? 0 : static_cast<int>(tables_[0].bits.size()); }
  /// Returns the memory that the descriptors and tables take, bytes.
  std::size_t memory_bytes() const;

 private:
  /// Aligns the descriptors, so that none straddles two cache lines.
  template <typename T>
  struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};
    T* allocate(std::size_t count) {
      return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
    }
    void deallocate(T* pointer, std::size_t) { ::operator delete(pointer, kAlignment); }
    bool operator==(const CacheLineAllocator&) const = default;
  };

  /// A hash table: bucket b holds ids[starts[b]] to ids[starts[b + 1] - 1], ascending.
  struct Table {
    KeyBits bits;
    std::vector<std::uint32_t> starts;
    std::vector<std::uint32_t> ids;
  };

  class Search;

  /// Builds one table for each element of `keys`, over the first `num_in_tables` descriptors.
  void MakeTables(const std::vector<KeyBits>& keys, int num_in_tables);
  void FillTable(Table& table) const;
  /// Computes sure_distances_.
  void PlanSearches();
  /// Returns the distance of the k-th neighbor up to which a search may end after `tables` tables
  /// have been probed with `flips` flips, -1 if there is none.
  int SureDistance(int flips, int tables) const;

  LshIndexOptions options_;
  std::vector<Descriptor, CacheLineAllocator<Descriptor>> descriptors_;
  int num_in_tables_ = 0;
  std::vector<Table> tables_;
  std::vector<int> sure_distances_;  ///< Indexed by flips, then by tables - 1.
};

}  // namespace corvo::orb
