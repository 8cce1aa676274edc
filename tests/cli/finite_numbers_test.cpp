// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "apps/run/run_inputs.h"
#include "tests/cli/command.h"
#include "tests/cli/expect_error.h"
#include "tests/data/temporary_folder.h"

namespace corvo::test {
namespace {

using ::testing::HasSubstr;

/// Every option that takes a fractional number, with the arguments that its command requires.
struct NumericOption {
  std::vector<std::string> arguments;
  std::string option;
  std::string rest;  ///< The text after the number.
};

std::vector<NumericOption> NumericOptions() {
  const std::vector<std::string> run = {"run", "in", "-o", "out"};
  const std::vector<std::string> eval = {"eval", "a", "b"};
  const std::vector<std::string> synth = {"synth", "room", "-o", "out"};
  return {{run, "--fps", ""},
          {run, "--fov", ""},
          {run, "--focal", ""},
          {run, "--max-dt", ""},
          {run, "--meters-per-unit", ""},
          {run, "--camera-height", ""},
          {run, "--known-distance", ",9,5"},
          {eval, "--max-dt", ""},
          {eval, "--rpe-seconds", ""},
          {eval, "--rpe-meters", ""},
          {eval, "--time-offset", ""},
          {{"calibrate", "in", "-o", "out"}, "--fps", ""},
          {synth, "--noise", ""},
          {synth, "--drift", ""},
          {synth, "--vignetting", ""},
          {synth, "--moving", ""},
          {synth, "--dark", ",1"},
          {synth, "--blur", ",1"},
          {synth, "--turn", ",1"}};
}

TEST(NumericOptionsOfCommands, RejectWhatIsNoFiniteNumber) {
  const TemporaryFolder folder;
  for (const NumericOption& option : NumericOptions()) {
    for (const char* text : {"nan", "-inf", "1e999"}) {
      std::vector<std::string> arguments = option.arguments;
      if (arguments.back() == "out") arguments.back() = folder / "out";
      arguments.push_back(option.option + "=" + text + option.rest);
      const CommandResult result = RunCorvo(arguments);
      EXPECT_EQ(result.exit_code, 1) << option.option << " " << text;
      EXPECT_THAT(result.err, HasSubstr(option.option)) << text;
      EXPECT_EQ(result.out, "");
      EXPECT_FALSE(std::filesystem::exists(folder / "out")) << option.option << " " << text;
    }
  }
}

TEST(NumericOptionsOfCommands, AcceptNegativeOffsets) {
  for (const std::vector<std::string>& offset :
       {std::vector<std::string>{"--time-offset", "-0.05"}, {"--time-offset=-5e-2"}}) {
    std::vector<std::string> arguments = {"eval", "a", "b"};
    arguments.insert(arguments.end(), offset.begin(), offset.end());
    EXPECT_THAT(RunCorvo(arguments).err, HasSubstr("a: cannot be read"));
  }
}

TEST(NumericOptionsOfCommands, ResizeStatesItsRange) {
  EXPECT_THAT(ErrorOf([] {
                ParseResize("100000x100000", {640, 480});
              }),
              HasSubstr("number of pixels is 10000000000; allowed is 256 to 100000000"));
  for (const char* size : {"nan", "nanxnan", "infx48", "1e999", "-1", "1e300"}) {
    EXPECT_THAT(ErrorOf([&] { ParseResize(size, {640, 480}); }), HasSubstr("--resize")) << size;
  }
}

}  // namespace
}  // namespace corvo::test
