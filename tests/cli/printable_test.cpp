// SPDX-License-Identifier: MIT
#include "apps/output/printable.h"

#include <gmock/gmock.h>

#include "tests/cli/command.h"
#include "tests/data/temporary_folder.h"

namespace corvo::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Printable, KeepsTextAndLayout) {
  EXPECT_EQ(Printable("a\tb\nc"), "a\tb\nc");
  EXPECT_EQ(Printable("h\xC3\xA4user/\xE2\x82\xAC/\xF0\x9F\x90\xA6"),
            "h\xC3\xA4user/\xE2\x82\xAC/\xF0\x9F\x90\xA6");
}

TEST(Printable, EscapesControlCharactersAndMalformedBytes) {
  EXPECT_EQ(Printable("\x1b[31m\r\x7f"), "\\x1b[31m\\x0d\\x7f");
  EXPECT_EQ(Printable("a\nb\tc", true), "a\\x0ab\\x09c");
  EXPECT_EQ(Printable(std::string("\0", 1)), "\\x00");
  EXPECT_EQ(Printable("\xC2\x9B"
                      "31m"),
            "\\xc2\\x9b31m");
  EXPECT_EQ(Printable("\x9B"
                      "31m \xFF \xC3"),
            "\\x9b31m \\xff \\xc3");
  EXPECT_EQ(Printable("\xC0\x80 \xED\xA0\x80"), "\\xc0\\x80 \\xed\\xa0\\x80");
}

TEST(Messages, EscapeFileNamesAndEntriesOfLists) {
  const TemporaryFolder folder;
  const std::string name = "evil\x1b[2J\nname";
  const std::vector<std::vector<std::string>> commands = {
      {"config", folder / name},
      {"eval", folder / name, folder / name},
      {"run", folder / name, "-o", folder / "out"},
      {"run", folder / "list", "-o", folder / "out"},
      {"features", folder / name, "-o", folder / "out"},
      {"config", "--" + name}};
  WriteText(folder / "list/rgb.txt", "1.5 \x1b[2Jevil.png\n");
  for (const auto& arguments : commands) {
    const CommandResult result = RunCorvo(arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, Not(HasSubstr("\x1b")));
    EXPECT_THAT(result.err, HasSubstr("\\x1b[2J"));
  }
}

}  // namespace
}  // namespace corvo::test
