// SPDX-License-Identifier: MIT
// These tests type words in each shell and let the completion of corvo continue them.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/command.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

/// Words that have one completion, which is their continuation.
struct Completion {
  std::string typed;
  std::string completed;
};

const Completion kCompletions[] = {
    {"corvo calib", "calibrate"},                 // A command.
    {"corvo fil", "film.mp4"},                    // The input of the shorthand.
    {"corvo run fil", "film.mp4"},                // The input of a command.
    {"corvo run --meters", "--meters-per-unit"},  // An option of a command,
    {"corvo run --json --qui", "--quiet"},        // of all commands,
    {"corvo synth room --nois", "--noise"},       // and of what a command renders.
    {"corvo run --camera cam", "camera.yaml"},    // The file of an option.
    {"corvo export result --to coll", ""},        // What is no choice of an option,
    {"corvo export result --to col", "colmap"},   // and a choice.
    {"corvo completion fis", "fish"},             // A choice of an argument.
    {"corvo synth stre", "street"},               // What a command renders.
    {"corvo export run --meters", ""},            // An option of another command.
};

constexpr const char* kMissing = "it is missing: scripts/install_dependencies.sh --development";

/// Returns whether a shell is installed. In continuous integration its lack is a failure.
bool HasShell(const std::string& shell) {
  const bool is_there = fs::exists("/usr/bin/" + shell);
  if (!is_there && DataIsRequired()) ADD_FAILURE() << shell << ": " << kMissing;
  return is_there;
}

/// A folder with files that arguments may name.
class CompletionTest : public testing::Test {
 protected:
  CompletionTest() {
    for (const char* name : {"film.mp4", "camera.yaml"}) WriteText(folder_ / name, "");
  }

  /// Writes corvo's script for a shell and returns its path.
  fs::path WriteScript(const std::string& shell, const std::string& name) const {
    const CommandResult script = RunCorvo({"completion", shell});
    EXPECT_EQ(script.exit_code, 0) << script.err;
    WriteText(folder_ / name, script.out);
    return folder_ / name;
  }

  /// Runs a script of a shell in the folder and returns its output.
  std::string Run(const std::string& shell, const std::string& script) const {
    WriteText(folder_ / "script", fmt::format("cd '{}'\n{}", folder_.path().string(), script));
    const fs::path home = folder_ / "home";
    fs::create_directories(home);
    return RunProgram("/usr/bin/" + shell, {folder_ / "script"},
                      {"PATH=/usr/bin:/bin", "TERM=xterm", "HOME=" + home.string()})
        .out;
  }

  TemporaryFolder folder_;
};

TEST_F(CompletionTest, OfBash) {
  const fs::path script = WriteScript("bash", "corvo.bash");
  for (const Completion& completion : kCompletions) {
    // As bash calls the function. It completes names of files itself where there is no reply.
    const std::string reply = Run("bash", fmt::format(R"(source '{}'
COMP_WORDS=({}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _corvo
if [ ${{#COMPREPLY[@]}} -eq 0 ]; then COMPREPLY=($(compgen -f -- "${{COMP_WORDS[-1]}}")); fi
printf '%s\n' "${{COMPREPLY[@]}}"
)",
                                                      script.string(), completion.typed));
    EXPECT_EQ(reply, completion.completed + "\n") << completion.typed;
  }
}

TEST_F(CompletionTest, OfBashKeepsBlanksInNamesOfFiles) {
  const fs::path script = WriteScript("bash", "corvo.bash");
  WriteText(folder_ / "my film.mp4", "");
  EXPECT_EQ(Run("bash", fmt::format("source '{}'; COMP_WORDS=(corvo my); COMP_CWORD=1; _corvo\n"
                                    "printf '%s\\n' \"${{COMPREPLY[@]}}\"",
                                    script.string())),
            "my film.mp4\n");
}

TEST_F(CompletionTest, OfBashKnowsValuesBehindAnEqualsSign) {
  const fs::path script = WriteScript("bash", "corvo.bash");
  // Bash makes three words of --to=col, of which the last may be missing.
  for (const std::string words : {"corvo export result --to = col", "corvo export result --to ="}) {
    const std::string reply =
        Run("bash", fmt::format("source '{}'; COMP_WORDS=({}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - "
                                "1)); _corvo; printf '%s\n' \"${{COMPREPLY[0]}}\"",
                                script.string(), words));
    EXPECT_EQ(reply, "colmap\n") << words;
  }
}

TEST_F(CompletionTest, OfFish) {
  if (!HasShell("fish")) GTEST_SKIP() << kMissing;
  const fs::path script = WriteScript("fish", "corvo.fish");
  for (const Completion& completion : kCompletions) {
    const std::string reply = Run(
        "fish", fmt::format("source '{}'; complete -C '{}'", script.string(), completion.typed));
    EXPECT_EQ(reply.substr(0, reply.find_first_of("\t\n")), completion.completed)
        << completion.typed;
    EXPECT_LE(std::ranges::count(reply, '\n'), 1) << completion.typed;
  }
}

TEST_F(CompletionTest, OfZsh) {
  if (!HasShell("zsh")) GTEST_SKIP() << kMissing;
  WriteScript("zsh", "functions/_corvo");
  // An interactive shell in a terminal, in which the completed words are printed, not run.
  std::string script = R"(zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'fpath=($PWD/functions $fpath); autoload -Uz compinit; compinit -u -D'
zpty -w shell 'corvo() { print -r -- "[${@[-1]}]" }'
)";
  for (const Completion& completion : kCompletions) {
    script += fmt::format("zpty -w shell $'{}\\t'\n", completion.typed);
  }
  script += "zpty -w shell exit\nwhile zpty -r shell line; do print -rn -- $line; done\n";
  const std::string output = Run("zsh", script);
  std::size_t position = 0;
  for (const auto& [typed, completed] : kCompletions) {
    const std::string last_typed = typed.substr(typed.rfind(' ') + 1);
    const std::string expected = "\n[" + (completed.empty() ? last_typed : completed) + "]";
    position = output.find(expected, position);
    ASSERT_NE(position, std::string::npos) << typed << ": no" << expected << " in\n" << output;
    ++position;
  }
}

TEST_F(CompletionTest, OfZshMayBeSourced) {
  if (!HasShell("zsh")) GTEST_SKIP() << kMissing;
  const fs::path script = WriteScript("zsh", "corvo.zsh");
  EXPECT_EQ(Run("zsh", fmt::format("autoload -Uz compinit; compinit -u -D; source '{}'\n"
                                   "print $_comps[corvo]",
                                   script.string())),
            "_corvo\n");
}

}  // namespace
}  // namespace corvo::test
