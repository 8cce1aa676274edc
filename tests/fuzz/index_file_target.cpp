// SPDX-License-Identifier: MIT
#include "orb/lsh_index.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace corvo::fuzz {
namespace {

using Word = std::uint64_t;

/// Returns the bytes, filled up to whole words, with their checksum behind them: a checksum that
/// does not match is otherwise all that is ever found.
std::string WithSum(Bytes bytes) {
  std::string text(bytes.begin(), bytes.end());
  text.resize((text.size() + sizeof(Word) - 1) / sizeof(Word) * sizeof(Word));
  Word sum = 0xcbf29ce484222325;
  for (std::size_t i = 0; i < text.size(); i += sizeof(Word)) {
    Word word = 0;
    std::memcpy(&word, text.data() + i, sizeof(word));
    sum = (sum ^ word) * 0x100000001b3;
  }
  text.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
  return text;
}

}  // namespace

void FuzzIndexFile(Bytes bytes) {
  Input input(bytes);
  const std::string text = input.Bool() ? WithSum(input.rest()) : input.Text();
  AllowError([&] {
    orb::LshIndex index = orb::LshIndex::Load(WriteScratchFile(text));
    const orb::Descriptor query{};
    for (const orb::Neighbor& neighbor : index.FindNearest(query, 3)) {
      Require(neighbor.index >= 0 && neighbor.index < index.size(), "a neighbor is of the set");
    }
    index.Add({&query, 1});
    Require(index.FindNearest(query, 1).at(0).distance == 0, "what was added is found");
  });
}

}  // namespace corvo::fuzz
