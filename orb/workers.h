// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace corvo::orb {

/// A set of threads that share a number of tasks; a single thread is the caller's.
class Workers {
 public:
  /// Uses at most `threads` threads, and no more than there are processors.
  explicit Workers(int threads)
      : count_(std::min(threads, tbb::info::default_concurrency())), arena_(count_) {}

  int count() const { return count_; }

  /// Calls `work(i)` for every i in [0, num_tasks); tasks start in this order.
  template <typename Work>
  void ForEach(int num_tasks, const Work& work) {
    if (count_ == 1 || num_tasks == 1) {
      for (int i = 0; i < num_tasks; ++i) work(i);
      return;
    }
    // What precedes the call happens before every task, and every task before the return. TBB
    // ensures this, too, but in a way that the thread sanitizer does not see.
    std::atomic<int> next, num_ended = 0;
    next.store(0);
    arena_.execute([&] {
      tbb::parallel_for(0, std::min(count_, num_tasks), [&](int) {
        for (int i = next++; i < num_tasks; i = next++) work(i);
        ++num_ended;
      });
    });
    num_ended.load();
  }

 private:
  int count_;
  tbb::task_arena arena_;
};

}  // namespace corvo::orb
