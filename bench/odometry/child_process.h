// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace corvo::bench {

/// The result of a task in its own process.
struct ChildOutcome {
  std::string output;
  double peak_memory_mb = 0;  ///< Peak memory of the process, units of 2^20 bytes.
};

/// Runs every task in a child process, at most `jobs` at once, and calls `done` in the parent with
/// the index of each finished task. The output of a task must not exceed 60 kB. Throws corvo::Error
/// with the child's message if a task fails. Must be called from a process with a single thread.
void RunInChildren(const std::vector<std::function<std::string()>>& tasks, int jobs,
                   const std::function<void(int task, const ChildOutcome&)>& done);

}  // namespace corvo::bench
