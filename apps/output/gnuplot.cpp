// SPDX-License-Identifier: MIT
#include "apps/output/gnuplot.h"

#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string_view>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Returns an unnamed temporary file with the content `text`, positioned at its start, or null if
/// it cannot be created.
File HoldText(const std::string& text) {
  File file(std::tmpfile());
  if (!file) return nullptr;
  std::fwrite(text.data(), 1, text.size(), file.get());
  if (std::fflush(file.get()) != 0) return nullptr;
  std::rewind(file.get());
  return file;
}

/// Returns whether a file ends with the last chunk of a PNG.
bool IsWholePng(const std::filesystem::path& file) {
  constexpr std::string_view kEnd = "IEND\xAE\x42\x60\x82";
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  std::string end(kEnd.size(), '\0');
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return stream.good() && end == kEnd;
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

}  // namespace

bool RunGnuplot(const std::string& script, const std::filesystem::path& output) {
  const File input = HoldText(script);
  if (input && Spawn(fileno(input.get()), output)) {
    // gnuplot reports no error if the disk is full.
    if (IsWholePng(output)) return true;
    throw Error(fmt::format("{}: cannot be written in full", output.string()));
  }
  std::error_code ignored;
  std::filesystem::remove(output, ignored);
  return false;
}

}  // namespace corvo
