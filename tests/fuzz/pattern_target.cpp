// SPDX-License-Identifier: MIT
#include <algorithm>

#include "orb/pattern_file.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace corvo::fuzz {
namespace {

/// Returns `text` with the lines of a valid pattern after it, as many as it lacks: a single wrong
/// line of 256 is otherwise out of reach.
std::string Completed(const std::string& text) {
  const std::string valid = orb::PatternText(orb::MakeBriefPattern(1));
  auto missing = orb::kNumTests - std::count(text.begin(), text.end(), ',') / 4;
  std::string completed = text + "\n";
  for (std::size_t begin = 0; missing > 0 && begin < valid.size(); --missing) {
    const std::size_t end = valid.find('\n', begin) + 1;
    completed += valid.substr(begin, end - begin);
    begin = end;
  }
  return completed;
}

}  // namespace

void FuzzPattern(Bytes bytes) {
  Input input(bytes);
  const bool is_completed = input.Bool();
  const std::string text = is_completed ? Completed(input.Text()) : input.Text();
  AllowError([&] {
    const orb::Pattern pattern = orb::ReadPattern(WriteScratchFile(text));
    Require(orb::ReadPattern(WriteScratchFile(orb::PatternText(pattern))) == pattern,
            "a pattern that is written is read back unchanged");
  });
}

}  // namespace corvo::fuzz
