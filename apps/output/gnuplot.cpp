// SPDX-License-Identifier: MIT
#include "apps/output/gnuplot.h"

#include <csignal>
#include <cstdio>
#include <string_view>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "apps/output/durable_file.h"
#include "apps/output/plot_format.h"
#include "apps/output/temporary_file.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

/// Returns an unnamed temporary file with the content `text`, positioned at its start, or null if
/// it cannot be created.
TemporaryFile HoldText(const std::string& text) {
  TemporaryFile file(std::tmpfile());
  if (!file) return nullptr;
  std::fwrite(text.data(), 1, text.size(), file.get());
  if (std::fflush(file.get()) != 0) return nullptr;
  std::rewind(file.get());
  return file;
}

/// Runs gnuplot with these files as standard input and output. Returns whether it succeeded.
bool Spawn(int input, const std::filesystem::path& output) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;  // Signals end gnuplot even while this process blocks them.
  posix_spawnattr_init(&attributes);
  sigset_t no_signals;
  sigemptyset(&no_signals);
  posix_spawnattr_setsigmask(&attributes, &no_signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  char name[] = "gnuplot";
  char* arguments[] = {name, nullptr};
  pid_t process = 0;
  const int error = posix_spawnp(&process, name, &actions, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return error == 0 && waitpid(process, &status, 0) == process && status == 0;
}

/// Replaces the times of creation in a PDF by a fixed one.
void RemoveDates(const std::filesystem::path& pdf) {
  constexpr std::string_view kKey = "/CreationDate (D:", kDate = "19700101000000";
  std::string bytes = ReadFileBytes(pdf, kMaxResultBytes);
  std::size_t key = 0;
  while ((key = bytes.find(kKey, key)) != std::string::npos) {
    key += kKey.size();
    if (key + kDate.size() < bytes.size()) bytes.replace(key, kDate.size(), kDate);
  }
  WriteFile(pdf, bytes);
}

}  // namespace

bool RunGnuplot(const std::string& script, const std::filesystem::path& output) {
  const TemporaryFile input = HoldText(script);
  if (input && Spawn(fileno(input.get()), output)) {
    // gnuplot reports no error if the disk is full.
    if (!IsWholePlot(output)) {
      throw Error(fmt::format("{}: cannot be written in full", output.string()));
    }
    if (ParsePlotFormat("plot", output) == PlotFormat::kPdf) RemoveDates(output);
    return true;
  }
  std::error_code ignored;
  std::filesystem::remove(output, ignored);
  return false;
}

}  // namespace corvo
