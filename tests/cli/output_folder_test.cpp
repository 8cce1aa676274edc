// SPDX-License-Identifier: MIT
#include "apps/output/output_folder.h"

#include <csignal>
#include <functional>
#include <map>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/system/durable_file.h"
#include "tests/cli/expect_error.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;
using test::ErrorOf;
using test::ReadText;
using test::TemporaryFolder;
using test::WriteText;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

OutputPlan PlanOf(std::vector<std::string> names) {
  OutputPlan plan;
  plan.names = std::move(names);
  plan.checkpoint = "checkpoint";
  return plan;
}

OutputPlan Forced(OutputPlan plan) {
  plan.replaces_foreign = true;
  return plan;
}

/// Writes a whole result of these files, each with the same content.
void WriteResult(const fs::path& folder, const std::vector<std::string>& names,
                 const std::string& text) {
  OutputFolder output(folder, PlanOf(names));
  for (const std::string& name : names) output.Write(name, text);
  output.Commit();
}

/// Returns the names and contents of all files in a folder.
std::map<std::string, std::string> FilesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).string()] = ReadText(entry.path());
    }
  }
  return files;
}

std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& [name, text] : FilesOf(folder)) names.push_back(name);
  return names;
}

/// Runs `action` again and again in another process until it is killed, after `delay_us`.
void KillWhile(const std::function<void()>& action, useconds_t delay_us) {
  const pid_t process = fork();
  if (process == 0) {
    try {
      while (true) action();
    } catch (...) {
      _exit(1);
    }
  }
  usleep(delay_us);
  kill(process, SIGKILL);
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
}

TEST(OutputFolder, PutsFilesInPlaceOnCommitOnly) {
  TemporaryFolder folder;
  const fs::path out = folder / "a/b";
  OutputFolder output(out, PlanOf({"x.txt"}));
  output.Write("x.txt", "new");
  EXPECT_FALSE(fs::exists(out / "x.txt"));
  output.Commit();
  EXPECT_EQ(ReadText(out / "x.txt"), "new");
  EXPECT_TRUE(output.HoldsCompleteResult());
}

TEST(OutputFolder, KeepsEarlierResultsWithoutCommit) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"x.txt"}, "old");
  const auto before = FilesOf(folder.path());
  {
    OutputFolder output(folder.path(), PlanOf({"x.txt"}));
    output.Write("x.txt", "new");
  }
  EXPECT_EQ(FilesOf(folder.path()), before);
}

TEST(OutputFolder, RemovesTheFolderItCreatedWithoutCommit) {
  TemporaryFolder folder;
  { OutputFolder output(folder / "new", PlanOf({})); }
  EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST(OutputFolder, RejectsForeignFilesInTheWayAndTouchesNothing) {
  TemporaryFolder folder;
  for (const char* name : {"x.txt", "part_7.txt", "manifest.json", "other.txt", "part_x.txt"}) {
    WriteText(folder / name, "mine");
  }
  const auto before = FilesOf(folder.path());
  OutputPlan plan = PlanOf({"x.txt", "y.txt"});
  plan.numbered_prefix = "part_";
  plan.numbered_suffix = ".txt";
  const std::string error = ErrorOf([&] { OutputFolder output(folder.path(), plan); });
  EXPECT_THAT(error, AllOf(HasSubstr(": x.txt, part_7.txt, manifest.json: not written by"),
                           HasSubstr("--force")));
  EXPECT_EQ(FilesOf(folder.path()), before);
  {
    OutputFolder output(folder.path(), Forced(plan));
    output.Write("x.txt", "new");
    output.Commit();
  }
  EXPECT_EQ(ReadText(folder / "x.txt"), "new");
  EXPECT_EQ(ReadText(folder / "other.txt"), "mine");
}

TEST(OutputFolder, RejectsAFileThatWasChangedSince) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"x.txt", "y.txt"}, "old");
  WriteText(folder / "y.txt", "OLD");
  EXPECT_THAT(ErrorOf([&] {
                OutputFolder output(folder.path(), PlanOf({"x.txt", "y.txt"}));
              }),
              HasSubstr(": y.txt: not written by"));
  EXPECT_EQ(ReadText(folder / "y.txt"), "OLD");
}

TEST(OutputFolder, NeverReplacesAFolder) {
  TemporaryFolder folder;
  WriteText(folder / "x.txt/mine", "");
  EXPECT_THAT(ErrorOf([&] { OutputFolder output(folder.path(), Forced(PlanOf({"x.txt"}))); }),
              HasSubstr("x.txt"));
}

TEST(OutputFolder, RemovesFilesOfAnEarlierRunThatAreNotWrittenAgain) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"x.txt", "image.png"}, "old");
  WriteText(folder / "users.txt", "kept");
  {
    OutputFolder output(folder.path(), PlanOf({"x.txt", "image.png"}));
    output.Write("x.txt", "new");
    output.Commit();
  }
  EXPECT_THAT(NamesIn(folder.path()), ElementsAre("manifest.json", "users.txt", "x.txt"));
}

TEST(OutputFolder, KeepsTheResultOfAnotherCommand) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"a.csv"}, "of another command");
  WriteResult(folder.path(), {"x.txt"}, "new");
  EXPECT_EQ(ReadText(folder / "a.csv"), "of another command");
  WriteResult(folder.path(), {"a.csv"}, "again");
  EXPECT_THAT(NamesIn(folder.path()), ElementsAre("a.csv", "manifest.json", "x.txt"));
}

TEST(OutputFolder, RejectsAFileThatAppearsBeforeTheCommit) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"x.txt"}, "old");
  OutputFolder output(folder.path(), PlanOf({"x.txt", "y.txt"}));
  output.Write("x.txt", "new");
  output.Write("y.txt", "new");
  WriteText(folder / "y.txt", "mine");
  EXPECT_THAT(ErrorOf([&] { output.Commit(); }), HasSubstr(": y.txt: not written by"));
  EXPECT_EQ(ReadText(folder / "x.txt"), "old");
  EXPECT_EQ(ReadText(folder / "y.txt"), "mine");
  output.CommitAsCheckpoint(true);
  EXPECT_EQ(ReadText(folder / "checkpoint/y.txt"), "new");
}

/// The target of the last file is a folder, so that its move fails after those of the others.
TEST(MoveIn, RestoresTheEarlierResultIfAFileCannotBeMoved) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"a.txt", "stale.txt"}, "old");
  const auto before = FilesOf(folder.path());
  const ResultPlaces places{folder.path(), folder / "work/new", folder / "work/old", kManifestName};
  WriteText(places.staged / "a.txt", "new");
  WriteText(places.staged / "z.txt", "new");
  WriteText(places.staged / kManifestName, ToText(Manifest{true, {{"a.txt", 3, 0}}}));
  WriteText(folder / "z.txt/in_the_way", "");
  bool is_torn = false;
  EXPECT_THAT(ErrorOf([&] { MoveIn(places, is_torn); }), HasSubstr("z.txt: cannot be written"));
  EXPECT_FALSE(is_torn);
  for (const auto& [name, text] : before) EXPECT_EQ(ReadText(folder / name), text);
  fs::remove_all(folder / "z.txt");
  MoveIn(places, is_torn);
  EXPECT_EQ(ReadText(folder / "a.txt"), "new");
  EXPECT_EQ(ReadText(folder / "z.txt"), "new");
  EXPECT_FALSE(fs::exists(folder / "stale.txt"));
}

TEST(MoveIn, RejectsFilesWithoutAManifestAndTouchesNothing) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"a.txt"}, "old");
  const auto before = FilesOf(folder.path());
  const ResultPlaces places{folder.path(), folder / "work/new", folder / "work/old", kManifestName};
  WriteText(places.staged / "a.txt", "new");
  bool is_torn = false;
  EXPECT_THAT(ErrorOf([&] { MoveIn(places, is_torn); }), HasSubstr("no staged result"));
  fs::remove_all(folder / "work");
  EXPECT_EQ(FilesOf(folder.path()), before);
}

TEST(OutputFolder, AfterAKillHoldsOneWholeResult) {
  TemporaryFolder folder;
  const std::vector<std::string> names = {"1.txt", "2.txt", "3.txt", "4.txt"};
  for (int i = 0; i < 40; ++i) {
    KillWhile(
        [&] {
          for (const char letter : {'a', 'b'}) {
            OutputFolder output(folder.path(),
                                PlanOf({"a", "b", "1.txt", "2.txt", "3.txt", "4.txt"}));
            for (const std::string& name : names) output.Write(name, std::string(10, letter));
            output.Write({&letter, 1}, "");
            output.Commit();
          }
        },
        static_cast<useconds_t>(1000 + 397 * i));
    {
      OutputFolder recovered(folder.path(), PlanOf({"a", "b", "1.txt", "2.txt", "3.txt", "4.txt"}));
    }
    if (!fs::exists(folder / "manifest.json")) continue;
    const std::string letter = ReadText(folder / "1.txt").substr(0, 1);
    std::vector<std::string> expected = names;
    expected.insert(expected.end(), {letter, "manifest.json"});
    ASSERT_EQ(NamesIn(folder.path()), expected) << i;
    for (const std::string& name : names) {
      ASSERT_EQ(ReadText(folder / name).substr(0, 1), letter) << i;
    }
  }
}

TEST(OutputFolder, AfterAKillHoldsAWholeCheckpoint) {
  TemporaryFolder folder;
  int num_found = 0;
  for (int i = 0; i < 40; ++i) {
    KillWhile(
        [&] {
          const OutputFolder output(folder.path(), PlanOf({"x.txt"}));
          for (char letter = 'a'; letter <= 'z'; ++letter) {
            WriteFile(output.StageCheckpoint("1.txt"), std::string(10, letter));
            WriteFile(output.StageCheckpoint("2.txt"), std::string(10, letter));
            output.SaveCheckpoint();
          }
        },
        // Flushing takes its time on a busy disk.
        static_cast<useconds_t>(1000 + (num_found > 0 ? 397 : 3970) * i));
    if (!fs::exists(folder / "checkpoint")) continue;
    ++num_found;
    const auto manifest = ReadManifest(folder / "checkpoint/manifest.json");
    ASSERT_TRUE(manifest) << i;
    EXPECT_FALSE(manifest->is_complete);
    ASSERT_EQ(manifest->files.size(), 2u);
    for (const ManifestFile& file : manifest->files) {
      ASSERT_TRUE(IsUnchanged(folder / "checkpoint" / file.name, file)) << i;
    }
    ASSERT_EQ(ReadText(folder / "checkpoint/1.txt"), ReadText(folder / "checkpoint/2.txt"));
  }
  EXPECT_GT(num_found, 0);
}

TEST(OutputFolder, CommitRemovesTheCheckpoint) {
  TemporaryFolder folder;
  OutputFolder output(folder.path(), PlanOf({"x.txt"}));
  WriteFile(output.StageCheckpoint("x.txt"), "part");
  output.SaveCheckpoint();
  EXPECT_EQ(ReadText(folder / "checkpoint/x.txt"), "part");
  output.Write("x.txt", "whole");
  output.Commit();
  EXPECT_THAT(NamesIn(folder.path()),
              ElementsAre(".corvo-unfinished/lock", "manifest.json", "x.txt"));
}

TEST(OutputFolder, RejectsAForeignFolderInPlaceOfTheCheckpoint) {
  TemporaryFolder folder;
  WriteText(folder / "checkpoint/weights.bin", "mine");
  EXPECT_THAT(ErrorOf([&] { OutputFolder output(folder.path(), PlanOf({"x.txt"})); }),
              HasSubstr(": checkpoint: not written by"));
  EXPECT_EQ(ReadText(folder / "checkpoint/weights.bin"), "mine");
}

TEST(OutputFolder, TellsASecondWriterAtOnce) {
  TemporaryFolder folder;
  {
    OutputFolder first(folder.path(), PlanOf({"x.txt"}));
    EXPECT_THAT(ErrorOf([&] { OutputFolder second(folder.path(), PlanOf({"x.txt"})); }),
                HasSubstr("another corvo is writing into this folder"));
    first.Write("x.txt", "first");
    first.Commit();
  }
  WriteResult(folder.path(), {"x.txt"}, "second");
  EXPECT_EQ(ReadText(folder / "x.txt"), "second");
}

TEST(OutputFolder, MakesAFolderThatWasRemovedMeanwhile) {
  TemporaryFolder folder;
  const fs::path out = folder / "out";
  OutputFolder output(out, PlanOf({"x.txt"}));
  fs::remove_all(out);
  output.Write("x.txt", "new");
  output.Commit();
  EXPECT_EQ(ReadText(out / "x.txt"), "new");
}

/// The limit of the size of files is a stand-in for a full disk: both make write() fail.
TEST(OutputFolder, ReportsAFileThatCannotBeWrittenInFull) {
  TemporaryFolder folder;
  WriteResult(folder.path(), {"x.txt"}, "old");
  OutputFolder output(folder.path(), PlanOf({"x.txt"}));
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit low{100, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &low);
  const std::string error = ErrorOf([&] { output.Write("x.txt", std::string(1000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(error, HasSubstr("x.txt: cannot be written: File too large"));
  EXPECT_EQ(ReadText(folder / "x.txt"), "old");
}

TEST(OutputFolder, RejectsAFileAsFolder) {
  TemporaryFolder folder;
  WriteText(folder / "file", "");
  EXPECT_THAT(ErrorOf([&] { OutputFolder output(folder / "file", PlanOf({})); }),
              HasSubstr("the output folder is a file"));
  EXPECT_THAT(ErrorOf([&] { OutputFolder output(folder / "file/inside", PlanOf({})); }),
              HasSubstr("cannot be written"));
}

TEST(PlanOfFile, ReplacesOnlyWhatItWrote) {
  TemporaryFolder folder;
  const fs::path file = folder / "camera.yaml";
  const auto write = [&](bool force) {
    OutputFolder output(folder.path(), PlanOfFile(file, {"camera.png"}, force));
    output.Write("camera.yaml", "new");
    output.Commit();
  };
  WriteText(file, "mine");
  EXPECT_THAT(ErrorOf([&] { write(false); }), HasSubstr("camera.yaml: not written by"));
  write(true);
  write(false);
  EXPECT_EQ(ReadText(file), "new");
  EXPECT_THAT(ErrorOf([&] { PlanOfFile(folder.path(), {}, false); }), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace corvo
