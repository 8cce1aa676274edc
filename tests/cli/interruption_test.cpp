// SPDX-License-Identifier: MIT
#include "apps/system/interruption.h"

#include <csignal>

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/cli/command.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kPinholeCamera =
    "model: pinhole\nwidth: 96\nheight: 64\nfx: 80\nfy: 81\ncx: 47\ncy: 31\n";

/// A command that reads a pipe without a writer, as an input of any kind, waits for it.
class CommandThatWaits : public testing::TestWithParam<int> {
 protected:
  CommandThatWaits() {
    EXPECT_EQ(mkfifo(pipe_.c_str(), 0600), 0);
    WriteFolder(folder_ / "images", 3);
    WriteText(folder_ / "camera.yaml", kPinholeCamera);
    WriteText(folder_ / "truth.txt", "1 0 0 0 0 0 0 1\n");
    fs::create_directories(folder_ / "list");
    fs::create_symlink(pipe_, folder_ / "list/rgb.txt");
  }

  void ExpectItEnds(const std::vector<std::string>& arguments) const {
    const CommandResult result = InterruptCorvoAtPipe(arguments, pipe_, GetParam());
    EXPECT_EQ(result.exit_code, ExitCodeOf(GetParam())) << arguments[0] << ": " << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, testing::StartsWith("corvo: error: interrupted"));
    EXPECT_FALSE(fs::exists(output_ / "trajectory.tum"));
  }

  TemporaryFolder folder_;
  fs::path pipe_ = folder_ / "pipe";
  fs::path images_ = folder_ / "images";
  fs::path camera_ = folder_ / "camera.yaml";
  fs::path output_ = folder_ / "out";
};

TEST_P(CommandThatWaits, EndsAtOnce) {
  ExpectItEnds({"config", pipe_});
  ExpectItEnds({"run", images_, "--camera", pipe_, "-o", output_});
  ExpectItEnds({"run", images_, "--camera", camera_, "--config", pipe_, "-o", output_});
  ExpectItEnds({"run", images_, "--camera", camera_, "--gt", pipe_, "-o", output_});
  ExpectItEnds({"run", images_, "--camera", camera_, "--mask", pipe_, "-o", output_});
  ExpectItEnds({"run", folder_ / "list", "--camera", camera_, "-o", output_});
  ExpectItEnds({"run", folder_ / "list", "--focal", "auto", "-o", output_});
  ExpectItEnds({"calibrate", folder_ / "list", "-o", folder_ / "c.yaml"});
  ExpectItEnds({"eval", pipe_, folder_ / "truth.txt"});
  ExpectItEnds({"eval", folder_ / "truth.txt", pipe_});
  ExpectItEnds({"features", pipe_, "-o", output_});
  ExpectItEnds({"match", pipe_, images_ / "0.png", "-o", output_});
  ExpectItEnds({"learn", images_, "--config", pipe_, "-o", folder_ / "p.inc"});
  ExpectItEnds({"synth", "room", "--camera", pipe_, "-o", output_});
}

INSTANTIATE_TEST_SUITE_P(BySignal, CommandThatWaits, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST(InterruptedSynth, RemovesWhatItHasWritten) {
  const TemporaryFolder folder;
  const CommandResult result = InterruptCorvo(
      {"synth", "room", "--width", "64", "--frames", "100000", "-o", folder / "room"},
      folder / "room/rgb/0.000000000.png", SIGINT);
  EXPECT_EQ(result.exit_code, kInterrupted);
  EXPECT_THAT(result.err, HasSubstr("interrupted; the images written so far were removed"));
  EXPECT_TRUE(fs::is_empty(folder / "room"));
}

TEST(EndOnInterruption, EndsTheProcessWithAMessage) {
  const auto interrupt = [] {
    EndOnInterruption();
    raise(SIGTERM);
  };
  EXPECT_EXIT(interrupt(), testing::ExitedWithCode(143), "interrupted; nothing was written");
}

TEST(Interruption, IsNotedUntilItIsAskedFor) {
  const Interruption interruption;
  EXPECT_FALSE(interruption.IsRequested());
  interruption.ThrowIfRequested();
  raise(SIGINT);
  EXPECT_TRUE(interruption.IsRequested());
  EXPECT_THROW(interruption.ThrowIfRequested(), Interrupted);
}

TEST(Interruption, EndsTheProcessIfNobodyAsksOrIfItIsRepeated) {
  const auto wait = [] {
    const Interruption interruption;
    raise(SIGINT);
    for (;;) pause();
  };
  EXPECT_EXIT(wait(), testing::ExitedWithCode(kInterrupted), "corvo: error: interrupted");
  const auto repeat = [] {
    const Interruption interruption;
    raise(SIGINT);
    raise(SIGINT);  // As timeout(1) does.
    if (!interruption.IsRequested()) return;
    usleep(1000 * (Interruption::kRepeatMs + 100));
    raise(SIGTERM);
  };
  EXPECT_EXIT(repeat(), testing::ExitedWithCode(143), "corvo: error: interrupted");
}

TEST(Interruption, IsDeferredWhileFilesAreMoved) {
  const auto commit = [] {
    EndOnInterruption();
    {
      const InterruptionDeferral deferral;
      raise(SIGTERM);
      raise(SIGINT);
    }
    _exit(7);
  };
  EXPECT_EXIT(commit(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace corvo::test
