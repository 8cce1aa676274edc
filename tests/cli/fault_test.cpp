// SPDX-License-Identifier: MIT
// Makes one system call of `corvo run` after the other fail (see fault_injection.cpp).
#include <algorithm>
#include <cerrno>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <gmock/gmock.h>

#include "apps/output/manifest.h"
#include "tests/cli/command.h"
#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

#ifdef CORVO_FAULT_INJECTION

namespace corvo::test {
namespace {

namespace fs = std::filesystem;

/// A logged call: its name, its file, and the new name of a renamed file or a number of calls.
struct Call {
  std::string name;
  std::string file;
  std::string other;
};

std::vector<Call> ReadCalls(const fs::path& log) {
  std::vector<Call> calls;
  std::istringstream text(ReadText(log));
  for (Call call; std::getline(text, call.name, '\t') && std::getline(text, call.file, '\t') &&
                  std::getline(text, call.other);) {
    calls.push_back(call);
  }
  return calls;
}

/// Returns the number of calls of this name.
long CountOf(const std::string& name, const std::vector<Call>& calls) {
  for (const Call& call : calls) {
    if (call.name == "count" && call.file == name) return std::stol(call.other);
  }
  return 0;
}

int CountLinesThatBegin(const std::string& text, const std::string& begin) {
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with(begin);
  return count;
}

/// Returns whether two results are those of the same run, apart from the time that it took.
bool IsSame(const fs::path& a, const fs::path& b) {
  const auto manifest = ReadManifest(a / kManifestName);
  if (!manifest) return false;
  return std::ranges::all_of(manifest->files, [&](const ManifestFile& file) {
    const bool depends_on_time = file.name == "timing.csv" || file.name == "environment.json";
    return depends_on_time || IsUnchanged(b / file.name, file);
  });
}

/// Returns whether the folder holds the files that its manifest lists and no others.
bool IsWhole(const fs::path& folder) {
  const auto manifest = ReadManifest(folder / kManifestName);
  if (!manifest) return false;
  std::set<std::string> names = {kManifestName};
  for (const ManifestFile& file : manifest->files) {
    if (!IsUnchanged(folder / file.name, file)) return false;
    names.insert(file.name);
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (entry.is_regular_file() && !names.contains(name)) return false;
  }
  return true;
}

/// A rendered sequence, and an earlier result that `corvo run` shall replace by a new one.
class FaultTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    const CommandResult room =
        RunCorvo({"synth", "room", "--frames", "60", "--width", "240", "-o", *shared_ / "room"});
    ASSERT_EQ(room.exit_code, 0) << room.err;
    ASSERT_EQ(RunInto(*shared_ / "old", "3", {}).exit_code, 0);
    ASSERT_EQ(RunInto(*shared_ / "new", "4", {}).exit_code, 0);
  }
  static void TearDownTestSuite() { shared_.reset(); }

  /// Runs `corvo run` on every n-th image. It is killed if it hangs.
  static CommandResult RunInto(const fs::path& output, const std::string& every,
                               std::vector<std::string> environment) {
    environment.emplace_back("PATH=/nowhere");
    return RunProgram("/usr/bin/timeout",
                      {"-s", "KILL", "120", CORVO_COMMAND, "run", *shared_ / "room", "--camera",
                       *shared_ / "room/camera.yaml", "--every", every, "-o", output},
                      environment);
  }

  /// Runs into a folder with the earlier result and checks what is left there.
  void RunWithFault(const std::string& fault, std::vector<std::string> environment) {
    SCOPED_TRACE(fault);
    fs::remove_all(output_);
    fs::copy(*shared_ / "old", output_);
    environment.insert(environment.end(),
                       {std::string("LD_PRELOAD=") + CORVO_FAULT_INJECTION,
                        "CORVO_FAULT_FOLDER=" + output_.string(), "CORVO_FAULT_LOG=" + log_});
    const CommandResult result = RunInto(output_, "4", environment);
    CheckEnd(result, fault.find("malloc") != std::string::npos);
    CheckFolder(result);
  }

  /// `libraries_complain`: libraries print lines of their own where their memory runs out.
  void CheckEnd(const CommandResult& result, bool libraries_complain) {
    ++num_runs_;
    num_errors_ += result.exit_code != 0;
    EXPECT_THAT(result.exit_code, testing::AnyOf(0, 1)) << result.err;
    EXPECT_EQ(CountLinesThatBegin(result.err, "corvo: error: "), result.exit_code) << result.err;
    EXPECT_TRUE(libraries_complain ||
                CountLinesThatBegin(result.err, "") == CountLinesThatBegin(result.err, "corvo: "))
        << result.err;
  }

  void CheckFolder(const CommandResult& result) const {
    EXPECT_TRUE(IsWhole(output_)) << result.err;
    const bool is_new = IsSame(*shared_ / "new", output_);
    EXPECT_TRUE(is_new || IsSame(*shared_ / "old", output_));
    EXPECT_TRUE(is_new || result.exit_code != 0);
    const fs::path checkpoint = output_ / "corvo_checkpoint";
    EXPECT_TRUE(!fs::exists(checkpoint) || IsWhole(checkpoint)) << result.err;
  }

  /// Returns the calls of a run without a fault.
  std::vector<Call> CallsOfOneRun() {
    RunWithFault("no fault", {});
    EXPECT_EQ(num_errors_, 0);
    return ReadCalls(log_);
  }

  /// Returns the first call that fails. Most allocations are those of the codecs' libraries while
  /// they are loaded with the first image; the loader, and GDAL for its tables, abort the process
  /// if they have no memory.
  static long FirstOf(const std::string& call, long count) {
    return call == "malloc" ? 3 * count / 4 : 1;
  }

  /// Makes each call of this name fail, or only some of them if there are more than `max_runs`.
  void FailEach(const std::string& call, int error, long max_runs = 1000) {
    const long count = CountOf(call, CallsOfOneRun());
    const long first = FirstOf(call, count);
    const long step = (count - first) / max_runs + 1;
    num_runs_ = 0;
    for (long n = first; n <= count; n += step) {
      RunWithFault(call + " " + std::to_string(n),
                   {"CORVO_FAULT_CALL=" + call, "CORVO_FAULT_N=" + std::to_string(n),
                    "CORVO_FAULT_ERROR=" + std::to_string(error)});
    }
    Report(call, count);
  }

  void Report(const std::string& call, long count) const {
    RecordProperty(call, std::to_string(count));
    std::cout << count << " " << call << " calls, " << num_runs_ << " runs with a fault, "
              << num_errors_ << " errors\n";
  }

  static std::unique_ptr<TemporaryFolder> shared_;
  TemporaryFolder folder_;
  fs::path output_ = fs::canonical(folder_.path()) / "out";
  std::string log_ = folder_ / "log";
  int num_runs_ = 0;
  int num_errors_ = 0;
};

std::unique_ptr<TemporaryFolder> FaultTest::shared_;

TEST_F(FaultTest, OfOpeningLeavesAWholeResult) {
  FailEach("open", EMFILE, 28);
  EXPECT_GT(num_errors_, 0);
}

TEST_F(FaultTest, OfReadingLeavesAWholeResult) {
  FailEach("read", EIO, 8);
  EXPECT_GT(num_errors_, 0);
}

TEST_F(FaultTest, OfWritingLeavesAWholeResult) {
  FailEach("write", EIO);
  EXPECT_EQ(num_errors_, num_runs_);
}

TEST_F(FaultTest, OfFlushingLeavesAWholeResult) {
  FailEach("fsync", EIO);
  EXPECT_EQ(num_errors_, num_runs_);
}

TEST_F(FaultTest, OfRenamingLeavesAWholeResult) {
  FailEach("rename", EXDEV);
  EXPECT_EQ(num_errors_, num_runs_);
}

TEST_F(FaultTest, OfAllocatingMemoryLeavesAWholeResult) {
  FailEach("malloc", ENOMEM, 12);
  EXPECT_GT(num_errors_, 0);
}

TEST_F(FaultTest, ThatLeavesNoMemoryAtAllLeavesAWholeResult) {
  const long count = CountOf("malloc", CallsOfOneRun());
  const long first = FirstOf("malloc", count);
  for (long n = first; n <= count; n += (count - first) / 7) {
    RunWithFault("all malloc from " + std::to_string(n),
                 {"CORVO_FAULT_CALL=malloc", "CORVO_FAULT_N=" + std::to_string(n),
                  "CORVO_FAULT_LAST=1000000000"});
  }
  Report("malloc", count);
}

TEST_F(FaultTest, ByAFullDiskLeavesAWholeResult) {
  std::uintmax_t num_bytes = 0;
  for (const auto& entry : fs::directory_iterator(*shared_ / "new")) num_bytes += entry.file_size();
  for (std::uintmax_t limit = 0; limit < num_bytes; limit += 4096) {
    RunWithFault("disk full after " + std::to_string(limit),
                 {"CORVO_FAULT_BYTES=" + std::to_string(limit)});
  }
  EXPECT_EQ(num_errors_, num_runs_);
  Report("4 KB", static_cast<long>(num_bytes / 4096));
}

/// After a power failure, a file may lack everything that was written after its last fsync.
TEST_F(FaultTest, ByAPowerFailureLeavesAWholeResult) {
  std::set<std::string> unflushed;
  std::vector<Call> moves_in;
  int num_manifests = 0;
  Call last_flush;
  for (const Call& call : CallsOfOneRun()) {
    if (call.name == "write") unflushed.insert(call.file);
    if (call.name == "fsync") unflushed.erase(call.file);
    if (call.name == "fsync") last_flush = call;
    if (call.name != "rename" || fs::path(call.other).parent_path() != output_) continue;
    EXPECT_FALSE(unflushed.contains(call.file)) << call.file;
    // The names of the other files are on disk before that of the manifest.
    if (fs::path(call.other).filename() == kManifestName) {
      ++num_manifests;
      EXPECT_EQ(last_flush.file, output_);
    }
    last_flush = {};
    moves_in.push_back(call);
  }
  ASSERT_EQ(num_manifests, 1);
  EXPECT_EQ(fs::path(moves_in.back().other).filename(), kManifestName);
  EXPECT_EQ(last_flush.file, output_);  // The folder, after the last move.
  std::cout << moves_in.size() << " files moved into place\n";
}

}  // namespace
}  // namespace corvo::test

#endif  // CORVO_FAULT_INJECTION
