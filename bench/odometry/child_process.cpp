// SPDX-License-Identifier: MIT
#include "bench/odometry/child_process.h"

#include <array>
#include <cstdlib>
#include <exception>
#include <map>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "orb/error.h"

namespace corvo::bench {
namespace {

struct Child {
  int task = 0;
  int pipe = 0;  ///< The child's output. A pipe holds 64 kB, so that the child never waits.
};

void WriteAll(int file, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(file, text.data() + written, text.size() - written);
    if (count <= 0) return;
    written += static_cast<std::size_t>(count);
  }
}

std::string ReadAll(int file) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t count = 0; (count = ::read(file, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  ::close(file);
  return text;
}

/// Runs the task, writes its output to the pipe and exits. Never returns.
[[noreturn]] void RunChild(const std::function<std::string()>& task, int output) {
  int status = 0;
  try {
    WriteAll(output, task());
  } catch (const std::exception& error) {
    WriteAll(output, error.what());
    status = 1;
  }
  ::_exit(status);
}

std::pair<pid_t, int> Start(const std::function<std::string()>& task) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw Error("no pipe to a child process");
  const pid_t child = ::fork();
  if (child < 0) throw Error("no child process");
  if (child == 0) RunChild(task, ends[1]);
  ::close(ends[1]);
  return {child, ends[0]};
}

}  // namespace

void RunInChildren(const std::vector<std::function<std::string()>>& tasks, int jobs,
                   const std::function<void(int, const ChildOutcome&)>& done) {
  std::map<pid_t, Child> children;
  int next = 0;
  const int num_tasks = static_cast<int>(tasks.size());
  while (next < num_tasks || !children.empty()) {
    while (next < num_tasks && static_cast<int>(children.size()) < jobs) {
      const auto [id, pipe] = Start(tasks[next]);
      children[id] = {next++, pipe};
    }
    int status = 0;
    rusage usage{};
    const auto node = children.extract(::wait4(-1, &status, 0, &usage));
    if (node.empty()) throw Error("a child process was lost");
    const std::string output = ReadAll(node.mapped().pipe);
    if (status != 0) throw Error(fmt::format("task {}: {}", node.mapped().task, output));
    done(node.mapped().task, {output, static_cast<double>(usage.ru_maxrss) / 1024});
  }
}

}  // namespace corvo::bench
