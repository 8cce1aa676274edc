// SPDX-License-Identifier: MIT
#include "orb/pattern_file.h"

#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "orb/error.h"
#include "orb/learned_pattern.h"

namespace corvo::orb {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t\r";

struct TestLine {
  BinaryTest test;
  int line = 0;  ///< Counted from 1.
};

void SkipBlanks(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
}

/// Removes "<integer>," and the blanks around its parts from the front of `text` and returns the
/// number, or std::nullopt if it does not start with one.
std::optional<int> TakeNumber(std::string_view& text) {
  SkipBlanks(text);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(end - text.data());
  SkipBlanks(text);
  if (text.empty() || text.front() != ',') return std::nullopt;
  text.remove_prefix(1);
  SkipBlanks(text);
  return value;
}

/// Parses the test in a line. `where` is the prefix of the error messages.
BinaryTest ParseTest(std::string_view line, const std::string& where) {
  std::int8_t coordinates[4];
  std::string_view rest = line;
  for (std::int8_t& coordinate : coordinates) {
    const std::optional<int> value = TakeNumber(rest);
    if (!value) {
      throw Error(where + "\"" + std::string(line) + "\"; allowed is \"px, py, qx, qy,\"");
    }
    CheckRange(where + "a coordinate", *value, -kMaxOffset, kMaxOffset);
    coordinate = static_cast<std::int8_t>(*value);
  }
  if (!rest.empty()) {
    throw Error(where + "\"" + std::string(rest) + "\" after the test; allowed is nothing");
  }
  return {{coordinates[0], coordinates[1]}, {coordinates[2], coordinates[3]}};
}

void CheckTest(const BinaryTest& test, const std::vector<TestLine>& others,
               const std::string& where) {
  if (!EndsApart(test)) throw Error(where + "p and q must be at least sqrt(2) px apart");
  for (const TestLine& other : others) {
    if (!AreEquivalent(test, other.test)) continue;
    throw Error(where + "the test of line " + std::to_string(other.line) +
                " again; allowed is each test once, and not with its ends swapped");
  }
}

bool IsComment(std::string_view line) {
  SkipBlanks(line);
  return line.empty() || line.substr(0, 2) == "//";
}

std::string CountText(std::size_t count) {
  return std::to_string(count) + " tests; allowed is " + std::to_string(kNumTests);
}

}  // namespace

Pattern ReadPattern(const fs::path& file) {
  std::ifstream stream(file);
  std::error_code ignored;
  if (!stream || fs::is_directory(file, ignored)) throw Error(file.string() + ": cannot be read");
  std::vector<TestLine> tests;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (IsComment(line)) continue;
    const std::string where = file.string() + ":" + std::to_string(number) + ": ";
    if (tests.size() == kNumTests) throw Error(where + "more than " + CountText(kNumTests));
    const BinaryTest test = ParseTest(line, where);
    CheckTest(test, tests, where);
    tests.push_back({test, number});
  }
  if (tests.size() != kNumTests) {
    throw Error(file.string() + ": has " + CountText(tests.size()));
  }
  Pattern pattern;
  for (int i = 0; i < kNumTests; ++i) pattern[i] = tests[i].test;
  return pattern;
}

std::string PatternText(const Pattern& pattern) {
  std::string text;
  for (const auto& [p, q] : pattern) {
    for (const Offset& end : {p, q}) {
      text += std::to_string(end.x) + ", " + std::to_string(end.y) + ", ";
    }
    text.back() = '\n';
  }
  return text;
}

Pattern LoadPattern(const std::string& name_or_file) {
  if (name_or_file == "learned") return LearnedPattern();
  if (name_or_file == "free") return FreePattern();
  if (name_or_file == "brief") return MakeBriefPattern();
  std::error_code ignored;  // Of a name that no file can have: it is too long.
  if (!fs::exists(name_or_file, ignored)) {
    throw Error("\"" + name_or_file +
                "\"; allowed is learned, brief, free or a file that is there");
  }
  return ReadPattern(name_or_file);
}

}  // namespace corvo::orb
