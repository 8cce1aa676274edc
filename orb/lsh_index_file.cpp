// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "orb/error.h"
#include "orb/lsh_index.h"

namespace corvo::orb {
namespace {

namespace fs = std::filesystem;

// An index file consists of a head, the descriptors, and a checksum of the words before it. Numbers
// are 64-bit little-endian words. The tables are rebuilt from the key bits in the head.

constexpr std::string_view kMagic = "corvoLSH";
constexpr std::uint64_t kVersion = 1;
constexpr std::size_t kMaxTables = 12;
constexpr std::size_t kMaxBits = 21;

using Word = std::uint64_t;

/// The head of a file.
struct Head {
  Word magic = 0;
  Word version = kVersion;
  Word num_tables = 0;
  Word max_flips = 0;
  double recall = 0;
  Word num_descriptors = 0;
  Word num_in_tables = 0;
  Word bits_a_key = 0;                                         ///< 0 if there are no tables.
  std::array<std::uint8_t, kMaxTables*(kMaxBits + 3)> bits{};  ///< By table, then zeros.
};
static_assert(sizeof(Head) % sizeof(Word) == 0 && std::is_trivially_copyable_v<Head>);
static_assert(std::endian::native == std::endian::little);

/// The FNV-1a hash (Fowler, Noll and Vo) over words; any change to a single word changes it.
class Sum {
 public:
  void Add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    for (std::size_t i = 0; i < size; i += sizeof(Word)) {
      Word word = 0;
      std::memcpy(&word, bytes + i, sizeof(word));
      value_ = (value_ ^ word) * 0x100000001b3;
    }
  }
  const Word& value() const { return value_; }

 private:
  Word value_ = 0xcbf29ce484222325;
};

Word Magic() {
  Word magic = 0;
  std::memcpy(&magic, kMagic.data(), sizeof(magic));
  return magic;
}

void Read(std::ifstream& stream, void* data, std::size_t size, const std::string& name) {
  stream.read(static_cast<char*>(data), static_cast<std::streamsize>(size));
  if (!stream) throw Error(name + ": cannot be read, or ends too early");
}

void CheckHead(const Head& head, const std::string& name) {
  if (head.magic != Magic()) throw Error(name + ": is no index");
  CheckRange(name + ": version", head.version, kVersion, kVersion);
  CheckRange<Word>(name + ": num_tables", head.num_tables, 1, kMaxTables);
  CheckRange<Word>(name + ": max_flips", head.max_flips, 0, kMaxBits);
  CheckRange(name + ": recall", head.recall, 0.0, 1.0);
  CheckRange<Word>(name + ": descriptors", head.num_descriptors, 0, 0x7fffffff);
  CheckRange<Word>(name + ": descriptors in tables", head.num_in_tables, 0, head.num_descriptors);
  // The memory of the tables grows with the keys, and is thus in proportion to the descriptors.
  const auto bits = head.num_in_tables > 0 ? static_cast<Word>(BitsAKey(head.num_in_tables)) : 0;
  CheckRange<Word>(name + ": bits a key", head.bits_a_key, bits, bits);
}

void CheckSize(const fs::path& file, const Head& head, const std::string& name) {
  const Word expected = sizeof(Head) + head.num_descriptors * sizeof(Descriptor) + sizeof(Word);
  std::error_code error;  // If set, the size is the largest integer.
  CheckRange<Word>(name + ": size in bytes", fs::file_size(file, error), expected, expected);
}

std::vector<KeyBits> KeysOf(const Head& head) {
  std::vector<KeyBits> keys;
  for (Word t = 0; head.num_in_tables > 0 && t < head.num_tables; ++t) {
    const auto* first = head.bits.data() + t * head.bits_a_key;
    keys.emplace_back(first, first + head.bits_a_key);
  }
  return keys;
}

}  // namespace

void LshIndex::Save(const fs::path& file) const {
  Head head;
  head.magic = Magic();
  head.num_tables = static_cast<Word>(options_.num_tables);
  head.max_flips = static_cast<Word>(options_.max_flips);
  head.recall = options_.recall;
  head.num_descriptors = descriptors_.size();
  head.num_in_tables = static_cast<Word>(num_in_tables_);
  head.bits_a_key = static_cast<Word>(bits_a_key());
  auto* next = head.bits.data();
  for (const Table& table : tables_) next = std::copy(table.bits.begin(), table.bits.end(), next);
  Sum sum;
  sum.Add(&head, sizeof(head));
  sum.Add(descriptors_.data(), descriptors_.size() * sizeof(Descriptor));
  std::ofstream stream(file, std::ios::binary);
  const auto write = [&](const void* data, std::size_t size) {
    stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  };
  write(&head, sizeof(head));
  write(descriptors_.data(), descriptors_.size() * sizeof(Descriptor));
  write(&sum.value(), sizeof(Word));
  stream.close();
  if (!stream) throw Error(file.string() + ": cannot be written");
}

LshIndex LshIndex::Load(const fs::path& file) {
  const std::string name = file.string();
  std::ifstream stream(file, std::ios::binary);
  std::error_code ignored;
  if (!stream || fs::is_directory(file, ignored)) throw Error(name + ": cannot be read");
  Head head;
  Read(stream, &head, sizeof(head), name);
  CheckHead(head, name);
  CheckSize(file, head, name);
  LshIndex index({.num_tables = static_cast<int>(head.num_tables),
                  .max_flips = static_cast<int>(head.max_flips),
                  .recall = head.recall});
  index.descriptors_.resize(head.num_descriptors);
  const std::size_t size = head.num_descriptors * sizeof(Descriptor);
  Read(stream, index.descriptors_.data(), size, name);
  Word stored = 0;
  Read(stream, &stored, sizeof(stored), name);
  Sum sum;
  sum.Add(&head, sizeof(head));
  sum.Add(index.descriptors_.data(), size);
  if (sum.value() != stored) throw Error(name + ": is damaged");
  if (head.num_in_tables > 0) {
    index.MakeTables(KeysOf(head), static_cast<int>(head.num_in_tables));
  }
  return index;
}

}  // namespace corvo::orb
