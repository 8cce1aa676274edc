#include "tests/cli/command.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/cli/temp_folder.h"

namespace corvo::test {
namespace {

/// argv or envp: pointers into `strings`, with the null that ends them.
std::vector<char*> Pointers(std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  for (std::string& string : strings) pointers.push_back(string.data());
  pointers.push_back(nullptr);
  return pointers;
}

CommandResult Run(const std::string& program, std::vector<std::string> arguments,
                  char** environment) {
  TempFolder folder;
  const std::string out = folder / "out";
  const std::string err = folder / "err";
  arguments.insert(arguments.begin(), program);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t process = 0;
  const int error = posix_spawn(&process, program.c_str(), &actions, nullptr,
                                Pointers(arguments).data(), environment);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error != 0 || waitpid(process, &status, 0) != process) {
    ADD_FAILURE() << "cannot run " << program;
    return {};
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadText(out), ReadText(err)};
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

}  // namespace corvo::test
