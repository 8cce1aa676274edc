// SPDX-License-Identifier: MIT
#include "tests/cli/command.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>

#include "tests/data/temporary_folder.h"
#include "tests/support/data.h"

namespace corvo::test {
namespace {

/// Returns an argv or envp array: pointers into `strings` and a terminating null.
std::vector<char*> Pointers(std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  for (std::string& string : strings) pointers.push_back(string.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// A running program whose output goes to files.
class Process {
 public:
  Process(const std::string& program, std::vector<std::string> arguments, char** environment,
          const std::string& err_file)
      : program_(program) {
    arguments.insert(arguments.begin(), program);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, Out().c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, 2,
                                     err_file.empty() ? Err().c_str() : err_file.c_str(),
                                     O_WRONLY | O_CREAT | O_NOCTTY, 0600);
    started_ = posix_spawn(&id_, program.c_str(), &actions, nullptr, Pointers(arguments).data(),
                           environment) == 0;
    posix_spawn_file_actions_destroy(&actions);
  }

  pid_t id() const { return id_; }
  bool HasEnded() {
    if (!ended_) ended_ = !started_ || waitpid(id_, &status_, WNOHANG) == id_;
    return ended_;
  }

  CommandResult Wait() {
    if (!started_ || (!ended_ && waitpid(id_, &status_, 0) != id_)) {
      ADD_FAILURE() << "cannot run " << program_;
      return {};
    }
    const std::string err = std::filesystem::exists(Err()) ? ReadText(Err()) : "";
    return {WIFEXITED(status_) ? WEXITSTATUS(status_) : -1, ReadText(Out()), err};
  }

 private:
  std::string Out() const { return folder_ / "out"; }
  std::string Err() const { return folder_ / "err"; }

  TemporaryFolder folder_;
  std::string program_;
  pid_t id_ = 0;
  bool started_ = false;
  bool ended_ = false;
  int status_ = 0;
};

CommandResult Run(const std::string& program, const std::vector<std::string>& arguments,
                  char** environment) {
  return Process(program, arguments, environment, "").Wait();
}

/// Returns everything written to the other end of a pseudo-terminal until every process has closed
/// it.
std::string ReadTerminal(int terminal) {
  std::string text;
  char buffer[4096];
  for (ssize_t size = 0; (size = read(terminal, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(size));
  }
  return text;
}

}  // namespace

CommandResult RunCorvo(const std::vector<std::string>& arguments) {
  return Run(CORVO_COMMAND, arguments, environ);
}

CommandResult RunCorvoAlone(const std::vector<std::string>& arguments) {
  return RunProgram(CORVO_COMMAND, arguments, {"PATH=/nowhere"});
}

CommandResult RunProgram(const std::string& program, const std::vector<std::string>& arguments,
                         std::vector<std::string> environment) {
  return Run(program, arguments, Pointers(environment).data());
}

CommandResult InterruptCorvo(const std::vector<std::string>& arguments,
                             const std::filesystem::path& file, int signal) {
  Process process(CORVO_COMMAND, arguments, environ, "");
  while (!process.HasEnded() && !std::filesystem::exists(file)) usleep(1000);
  if (!process.HasEnded()) kill(process.id(), signal);
  return process.Wait();
}

CommandResult InterruptCorvoAtPipe(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& pipe, int signal) {
  Process process(CORVO_COMMAND, arguments, environ, "");
  int writer = -1;  // It can be opened as soon as there is a reader.
  while (!process.HasEnded() && writer < 0) {
    writer = open(pipe.c_str(), O_WRONLY | O_NONBLOCK);
    usleep(1000);
  }
  if (!process.HasEnded()) kill(process.id(), signal);
  const CommandResult result = process.Wait();
  close(writer);
  return result;
}

CommandResult RunCorvoOnTerminal(const std::vector<std::string>& arguments) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) {
    ADD_FAILURE() << "no pseudo-terminal";
    return {};
  }
  Process process(CORVO_COMMAND, arguments, environ, ptsname(terminal));
  const std::string shown = ReadTerminal(terminal);
  close(terminal);
  CommandResult result = process.Wait();
  result.err = shown;
  return result;
}

int CountLines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace corvo::test
