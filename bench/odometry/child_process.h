// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace corvo::bench {

/// What a task gave in a process of its own.
struct ChildOutcome {
  std::string output;
  double peak_memory_mb = 0;  ///< Of its process, 2^20 bytes.
};

/// Runs every task in a child process, at most `jobs` at once, and calls `done` in the parent after
/// each, with its index. What tasks return is at most 60 kB. Throws corvo::Error with the child's
/// words where one fails. Only from a process with one thread.
void RunInChildren(const std::vector<std::function<std::string()>>& tasks, int jobs,
                   const std::function<void(int task, const ChildOutcome&)>& done);

}  // namespace corvo::bench
