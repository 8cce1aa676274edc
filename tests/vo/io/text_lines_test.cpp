// SPDX-License-Identifier: MIT
#include "vo/io/text_lines.h"

#include <gmock/gmock.h>

#include "tests/support/data.h"
#include "tests/support/matchers.h"

namespace corvo {
namespace {

using test::ThrowsError;
using ::testing::ElementsAre;

TEST(TextLinesTest, SkipsBlankLinesAndCommentsButCountsThem) {
  const test::TemporaryDir dir;
  const auto lines = ReadTextLines(dir.Write("a.txt", "# comment\n\n  one 1\r\n\t# more\ntwo"));
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[0].number, 3);
  EXPECT_EQ(lines[0].text, "one 1");
  EXPECT_EQ(lines[1].number, 5);
  EXPECT_EQ(lines[1].text, "two");
  EXPECT_EQ(LinePrefix("a.txt", lines[1]), "a.txt:5: ");
}

TEST(TextLinesTest, NamesTheFileThatCannotBeRead) {
  const test::TemporaryDir dir;
  EXPECT_THAT([&] { ReadTextLines(dir.path() / "none.txt"); }, ThrowsError("none.txt"));
  EXPECT_THAT([&] { ReadTextLines(dir.path()); }, ThrowsError(dir.path().string()));
}

TEST(TextLinesTest, SplitsAtBlanksOrAtASeparator) {
  EXPECT_THAT(SplitFields("a \t b  c", ' '), ElementsAre("a", "b", "c"));
  EXPECT_THAT(SplitFields("a, b ,,c", ','), ElementsAre("a", "b", "", "c"));
}

TEST(TextLinesTest, ParsesFiniteNumbersOnly) {
  EXPECT_EQ(ParseNumber("-1.5e3", ""), -1500);
  EXPECT_EQ(ParseNumber("+2", ""), 2);
  for (const char* text : {"", "nan", "inf", "1x", "1 2", "+-1", "0x10", "1e999", "--1"}) {
    EXPECT_THAT([&] { ParseNumber(text, "f:3: "); }, ThrowsError("f:3: ", text)) << text;
  }
}

}  // namespace
}  // namespace corvo
