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
  const test::TemporaryFolder dir;
  const auto lines = ReadTextLines(dir.Write("a.txt", "# comment\n\n  one 1\r\n\t# more\ntwo"));
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[0].number, 3);
  EXPECT_EQ(lines[0].text, "one 1");
  EXPECT_EQ(lines[1].number, 5);
  EXPECT_EQ(lines[1].text, "two");
  EXPECT_EQ(LinePrefix("a.txt", lines[1]), "a.txt:5: ");
}

TEST(TextLinesTest, NamesTheFileThatCannotBeRead) {
  const test::TemporaryFolder dir;
  EXPECT_THAT([&] { ReadTextLines(dir.path() / "none.txt"); }, ThrowsError("none.txt"));
  EXPECT_THAT([&] { ReadTextLines(dir.path()); }, ThrowsError(dir.path().string()));
}

TEST(TextLinesTest, LinesEndWithAnyConventionAndAByteOrderMarkIsSkipped) {
  const test::TemporaryFolder dir;
  const auto lines = ReadTextLines(dir.Write("a.txt", "\xEF\xBB\xBFone\r\ntwo\rthree\n\rfive"));
  ASSERT_EQ(lines.size(), 4);
  EXPECT_EQ(lines[0].text, "one");
  EXPECT_EQ(lines[2].text, "three");
  EXPECT_EQ(lines[3].number, 5);
  EXPECT_THAT(
      [&] {
        ReadTextLines(dir.Write("b.txt",
                                "\xFF\xFE"
                                "a"));
      },
      ThrowsError("b.txt: is UTF-16"));
  EXPECT_THAT([&] { ReadTextLines(dir.Write("c.txt", std::string("a\0b", 3))); },
              ThrowsError("c.txt: is not a text file"));
}

TEST(TextLinesTest, NumberOfLinesIsLimited) {
  const test::TemporaryFolder dir;
  std::string text = "# comment\n\n";
  for (std::size_t i = 0; i < kMaxTextLines; ++i) text += "1\n";
  EXPECT_EQ(ReadTextLines(dir.Write("a.txt", text)).size(), kMaxTextLines);
  EXPECT_THAT([&] { ReadTextLines(dir.Write("a.txt", text + "1\n")); },
              ThrowsError("a.txt: has more than 2000000 lines"));
}

TEST(TextLinesTest, TablesMayHaveAHeaderRow) {
  const test::TemporaryFolder dir;
  const auto lines = ReadTableLines(dir.Write("a.txt", "timestamp tx ty\n1 2 3\n"));
  ASSERT_EQ(lines.size(), 1);
  EXPECT_EQ(lines[0].number, 2);
  EXPECT_EQ(ReadTableLines(dir.Write("b.txt", "two 2 3\n1 2 3\n")).size(), 2);
  EXPECT_TRUE(ReadTableLines(dir.Write("c.txt", "")).empty());
}

TEST(TextLinesTest, SplitsAtBlanksTabsCommasAndSemicolons) {
  EXPECT_THAT(SplitFields("a \t b  c"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(SplitFields("a, b ,c;d"), ElementsAre("a", "b", "c", "d"));
  EXPECT_THAT(SplitFields("a,,c"), ElementsAre("a", "", "c"));
  EXPECT_THAT(SplitFields("a,b,"), ElementsAre("a", "b", ""));
  EXPECT_EQ(AfterFirstField("1.5,  my images/a b.png "), "my images/a b.png");
  EXPECT_EQ(AfterFirstField("1.5"), "");
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
