// SPDX-License-Identifier: MIT
#include "orb/pattern_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "orb/learned_pattern.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo::orb {
namespace {

using test::ThrowsError;

class PatternFileTest : public ::testing::Test {
 protected:
  Pattern Read(const std::string& text) const { return ReadPattern(dir_.Write("p.inc", text)); }

  /// Returns the text of a valid file with line `number` (from 1) replaced.
  static std::string WithLine(int number, const std::string& replacement) {
    std::istringstream lines(PatternText(MakeBriefPattern()));
    std::string text;
    std::string line;
    for (int i = 1; std::getline(lines, line); ++i) {
      text += (i == number ? replacement : line) + "\n";
    }
    return text;
  }

  test::TemporaryFolder dir_;
};

TEST_F(PatternFileTest, WrittenPatternsReadBackTheSame) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Pattern pattern = MakeBriefPattern(seed);
    EXPECT_EQ(Read(PatternText(pattern)), pattern);
  }
}

TEST_F(PatternFileTest, EachTestIsWrittenAsOneLine) {
  Pattern pattern = MakeBriefPattern();
  pattern[0] = {{-13, 2}, {0, 13}};
  const std::string text = PatternText(pattern);
  EXPECT_EQ(text.substr(0, text.find('\n')), "-13, 2, 0, 13,");
}

TEST_F(PatternFileTest, CommentsBlanksAndWindowsLineEndsAreIgnored) {
  const std::string line = "-13, 2, 0, 13,";
  const Pattern expected = Read(WithLine(4, line));
  EXPECT_EQ(Read("// by corvo learn\r\n\n \t\n" + WithLine(4, line)), expected);
  EXPECT_EQ(Read(WithLine(4, " -13,2 ,\t0,  13 , \r")), expected);
  EXPECT_EQ(Read(WithLine(4, line + "\n  // so far 4")), expected);
  const std::string text = WithLine(4, line);
  EXPECT_EQ(Read(text.substr(0, text.size() - 1)), expected) << "last line without a line end";
}

TEST_F(PatternFileTest, MalformedLinesAreErrors) {
  for (const char* line : {"1, 2, 3, 4", "1, 2, 3,", "1 2 3 4", "a, 2, 3, 4,", "1.5, 2, 3, 4,",
                           "1, , 3, 4,", "# 1", "/ 1, 2, 3, 4,", "99999999999, 2, 3, 4,"}) {
    EXPECT_THAT([&] { Read(WithLine(7, line)); },
                ThrowsError("p.inc:7: ", line, "allowed is \"px, py, qx, qy,\""));
  }
  EXPECT_THAT([&] { Read(WithLine(7, "1, 2, 3, 9, 5,")); },
              ThrowsError("p.inc:7: ", "\"5,\" after the test"));
}

TEST_F(PatternFileTest, CoordinatesOutsideThePatchAreErrors) {
  EXPECT_THAT([&] { Read(WithLine(9, "0, 14, 0, 0,")); },
              ThrowsError("p.inc:9: ", "is 14; allowed is -13 to 13"));
  EXPECT_THAT([&] { Read(WithLine(9, "0, 0, 0, -300,")); }, ThrowsError("p.inc:9: ", "is -300"));
}

TEST_F(PatternFileTest, EndsThatTouchAreErrors) {
  for (const char* line : {"3, 4, 3, 4,", "3, 4, 3, 5,", "3, 4, 2, 4,"}) {
    EXPECT_THAT([&] { Read(WithLine(256, line)); }, ThrowsError("p.inc:256: ", "sqrt(2) px"));
  }
}

TEST_F(PatternFileTest, RepeatedAndReversedTestsAreErrors) {
  const auto [p, q] = MakeBriefPattern()[2];
  for (const BinaryTest& test : {BinaryTest{p, q}, BinaryTest{q, p}}) {
    Pattern pattern = MakeBriefPattern();
    pattern[99] = test;
    EXPECT_THAT([&] { Read(PatternText(pattern)); }, ThrowsError("p.inc:100: ", "of line 3 again"));
  }
}

TEST_F(PatternFileTest, WrongNumberOfTestsIsAnError) {
  EXPECT_THAT([&] { Read(WithLine(1, "")); }, ThrowsError("p.inc: has 255 tests; allowed is 256"));
  EXPECT_THAT([&] { Read(WithLine(0, "") + "1, 2, 3, 9,\n"); },
              ThrowsError("p.inc:257: more than 256 tests"));
  EXPECT_THAT([&] { Read(""); }, ThrowsError("p.inc: has 0 tests"));
}

TEST_F(PatternFileTest, FilesThatCannotBeReadAreErrors) {
  EXPECT_THAT([&] { ReadPattern(dir_.path() / "none"); }, ThrowsError("none: cannot be read"));
  EXPECT_THAT([&] { ReadPattern(dir_.path()); }, ThrowsError(": cannot be read"));
}

TEST_F(PatternFileTest, DamagedFilesAreReadOrReportedByName) {
  test::Random random(5);
  const std::string whole = PatternText(MakeBriefPattern());
  for (int i = 0; i < 500; ++i) {
    std::string text = whole;
    text.resize(random.UniformInt(0, static_cast<int>(text.size())));
    for (int k = random.UniformInt(0, 3); k > 0 && !text.empty(); --k) {
      text[random.Bits() % text.size()] = static_cast<char>(random.UniformInt(0, 255));
    }
    try {
      const Pattern pattern = Read(text);
      EXPECT_EQ(Read(PatternText(pattern)), pattern);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("p.inc:"));
    }
  }
}

TEST_F(PatternFileTest, PatternsAreLoadedByNameOrFile) {
  EXPECT_EQ(LoadPattern("learned"), LearnedPattern());
  EXPECT_EQ(LoadPattern("brief"), MakeBriefPattern());
  const auto file = dir_.Write("p.inc", PatternText(MakeBriefPattern(3)));
  EXPECT_EQ(LoadPattern(file.string()), MakeBriefPattern(3));
  EXPECT_THAT([] { LoadPattern("biref"); }, ThrowsError("\"biref\"", "allowed is learned, brief"));
  EXPECT_THAT([] { LoadPattern(""); }, ThrowsError("\"\"", "allowed is learned, brief"));
}

TEST_F(PatternFileTest, ANameThatNoFileCanHaveIsAnError) {
  const std::string too_long(300, 'a');
  EXPECT_THAT([&] { LoadPattern(too_long); }, ThrowsError(too_long, "allowed is learned, brief"));
  EXPECT_THAT([&] { ReadPattern(too_long); }, ThrowsError(too_long, "cannot be read"));
}

}  // namespace
}  // namespace corvo::orb
