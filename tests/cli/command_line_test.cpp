// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/cli/command.h"

namespace corvo::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

class Help : public testing::TestWithParam<const char*> {};

TEST_P(Help, HasRunnableExamples) {
  const CommandResult result = RunCorvo({GetParam(), "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("Usage"), HasSubstr("\n  corvo " + std::string(GetParam()) + " ")));
}

INSTANTIATE_TEST_SUITE_P(Commands, Help,
                         testing::Values("run", "eval", "synth", "features", "match", "learn",
                                         "config"),
                         [](const auto& param_info) { return std::string(param_info.param); });

TEST(CommandLine, HelpListsTheCommands) {
  const CommandResult result = RunCorvo({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("run"), HasSubstr("eval"), HasSubstr("synth"), HasSubstr("features"),
                    HasSubstr("match"), HasSubstr("config"), HasSubstr("Examples:")));
}

TEST(CommandLine, WithoutArgumentsPrintsTheHelp) {
  const CommandResult result = RunCorvo({});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, RunCorvo({"--help"}).out);
}

TEST(CommandLine, AMisspeltCommandIsAnsweredWithTheNearest) {
  EXPECT_THAT(RunCorvo({"clibrate", "a.mp4"}).err,
              HasSubstr("'clibrate' is neither a command nor a file or folder; the nearest command "
                        "is calibrate"));
}

TEST(CommandLine, CompletionNamesEveryOptionInEveryShell) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const CommandResult result = RunCorvo({"completion", shell});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("meters-per-unit"), HasSubstr("undistort"))) << shell;
  }
}

TEST(CommandLine, ManualPagesHaveTheSectionsOfMan) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"manual"}, std::vector<std::string>{"manual", "run"}}) {
    const CommandResult result = RunCorvo(arguments);
    EXPECT_EQ(result.exit_code, 0);
    for (const char* section : {".TH corvo", ".SH NAME\n", ".SH SYNOPSIS\n", ".SH OPTIONS\n"}) {
      EXPECT_THAT(result.out, HasSubstr(section));
    }
  }
  EXPECT_THAT(RunCorvo({"manual", "run"}).out, HasSubstr("\\fB\\-\\-meters\\-per\\-unit\\fR"));
  EXPECT_THAT(RunCorvo({"manual", "synth"}).out,
              AllOf(HasSubstr("\\fBcorridor\\fR\n"), HasSubstr("\\fB\\-\\-vignetting\\fR")));
  EXPECT_EQ(RunCorvo({"manual", "fly"}).exit_code, 1);
}

TEST(CommandLine, PrintsItsVersion) {
  const CommandResult result = RunCorvo({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

class WrongUsage : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(WrongUsage, PrintsOneLineAndExitsWith1) {
  const CommandResult result = RunCorvo(GetParam());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, StartsWith("corvo: error: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, WrongUsage,
    testing::Values(std::vector<std::string>{"fly"}, std::vector<std::string>{"completion", "tcsh"},
                    std::vector<std::string>{"run"}, std::vector<std::string>{"run", "folder"},
                    std::vector<std::string>{"run", "folder", "-o", "out", "--fps", "-3"},
                    std::vector<std::string>{"run", "folder", "-o", "out", "--threads", "many"},
                    std::vector<std::string>{"eval", "one.tum"},
                    std::vector<std::string>{"eval", "none.tum", "none.tum"},
                    std::vector<std::string>{"eval", "a", "b", "--align", "sideways"},
                    std::vector<std::string>{"features", "-o", "out"},
                    std::vector<std::string>{"features", "none.png", "-o", "out"},
                    std::vector<std::string>{"features", "none.png"},
                    std::vector<std::string>{"match", "a.png", "-o", "out"},
                    std::vector<std::string>{"match", "a.png", "b.png", "-o", "out"},
                    std::vector<std::string>{"learn", "-o", "p.inc"},
                    std::vector<std::string>{"learn", "none.png", "-o", "p.inc"},
                    std::vector<std::string>{"learn", "none.png"},
                    std::vector<std::string>{"learn", "a.png", "-o", "p", "--keypoints", "999"},
                    std::vector<std::string>{"config", "no/such/file.yaml"}));

TEST(CommandLine, RenamedOptionsAreReportedWithTheirNewNames) {
  EXPECT_THAT(RunCorvo({"run", "folder", "-o", "out", "--metres-per-unit", "2"}).err,
              HasSubstr("--metres-per-unit: is now --meters-per-unit"));
  EXPECT_THAT(RunCorvo({"eval", "a", "b", "--rpe-metres", "5"}).err,
              HasSubstr("--rpe-metres: is now --rpe-meters"));
}

}  // namespace
}  // namespace corvo::test
