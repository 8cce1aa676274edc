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

/// Options of LshIndex. `Visit` names every field once, with its range and meaning.
struct LshIndexOptions {
  int num_tables = 8;
  int max_flips = 2;
  double recall = 0.8;

  /// Throws corvo::Error naming the first field out of range.
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

/// Descriptor `index` of a set, and how far it is from a query.
struct Neighbor {
  int distance = 257;  ///< Bits.
  int index = -1;

  bool operator==(const Neighbor&) const = default;
  bool operator<(const Neighbor& other) const {
    return distance != other.distance ? distance < other.distance : index < other.index;
  }
};

/// Finds the descriptors that are nearest to a query among millions. Multi-probe locality-sensitive
/// hashing (Lv et al., "Multi-probe LSH", VLDB 2007) over disjoint bits, as in multi-index hashing
/// (Norouzi et al., "Fast search in Hamming space with multi-index hashing", CVPR 2012), but of
/// little correlation. A search looks into the query's bucket of every table, then into those one
/// flipped bit of the key away, then two, and takes all bits to flip alike: a descriptor at
/// distance d has been found in l of L tables with up to r flips, in the others with r - 1, with
///
///     1 - (1 - p_r(d))^l (1 - p_{r - 1}(d))^{L - l},   p_r(d) = ChanceOfFlips(d, ., r).
///
/// With recall 1 and as many flips as bits it is exact. The same calls give the same answers.
/// Searches may run at once; nothing else may meanwhile.
class LshIndex {
 public:
  /// Throws corvo::Error on options out of range.
  explicit LshIndex(const LshIndexOptions& options = {});
  explicit LshIndex(std::span<const Descriptor> descriptors, const LshIndexOptions& options = {});

  /// Appends descriptors; the first is number size(). Those added last, at most 4096 or one in 32,
  /// whichever is more, are in no table: they are compared with every query.
  void Add(std::span<const Descriptor> descriptors);

  /// The k nearest found, nearest first; between equal distances the lower index is nearer. There
  /// may be fewer than min(k, size()). Throws corvo::Error unless k is 1 or more.
  std::vector<Neighbor> FindNearest(const Descriptor& query, int k) const;

  /// Writes a file that Load() reads back the same. Throws corvo::Error where it cannot.
  void Save(const std::filesystem::path& file) const;

  /// Throws corvo::Error where the file cannot be read, is of another version, or is damaged.
  static LshIndex Load(const std::filesystem::path& file);

  int size() const { return static_cast<int>(descriptors_.size()); }
  const Descriptor& descriptor(int index) const { return descriptors_[index]; }
  const LshIndexOptions& options() const { return options_; }
  /// Of one key, 0 where nothing is in a table.
  int bits_a_key() const { return tables_.empty() ? 0 : static_cast<int>(tables_[0].bits.size()); }
  /// What descriptors and tables take.
  std::size_t memory_bytes() const;

 private:
  /// A descriptor never straddles two cache lines.
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

  /// Descriptors by key: bucket b holds ids[starts[b]] to ids[starts[b + 1] - 1], ascending.
  struct Table {
    KeyBits bits;
    std::vector<std::uint32_t> starts;
    std::vector<std::uint32_t> ids;
  };

  class Search;

  /// Puts all descriptors into tables with keys of these bits.
  void MakeTables(const std::vector<KeyBits>& keys, int num_in_tables);
  void FillTable(Table& table) const;
  /// Sets sure_distances_.
  void PlanSearches();
  /// A search may end after `tables` tables of round `flips` if its k-th nearest is no further.
  int SureDistance(int flips, int tables) const;

  LshIndexOptions options_;
  std::vector<Descriptor, CacheLineAllocator<Descriptor>> descriptors_;
  int num_in_tables_ = 0;
  std::vector<Table> tables_;
  std::vector<int> sure_distances_;  ///< By flips, then tables - 1.
};

}  // namespace corvo::orb
