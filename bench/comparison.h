// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace corvo::bench {

/// A function that processes an item, counted from 0, and returns the number of results. It may
/// reuse memory between calls.
using Work = std::function<std::size_t(int item)>;

/// corvo and the baseline that it is compared with.
struct Contenders {
  Work contender;
  Work baseline;
  std::string images;  ///< The source of the images, from ImageSet::Source().
};

struct Comparison {
  std::string title;
  int items = 0;
  int threads = 1;  ///< OpenCV's. One thread's processor time is measured, else wall time.
  std::function<Contenders()> prepare;  ///< Called once, with the instruction set in use.
};

/// Registers a comparison with Google Benchmark as "title/instruction_set". In each iteration, both
/// contenders process one item; their order alternates, so that neither always finds the item in
/// the cache. Each item is visited `repeats` times, with all other items in between; the least time
/// of each contender counts. The counters are those of PairedSummary and the mean numbers of
/// `results` and `baseline_results`.
void Register(const Comparison& comparison, const std::string& instruction_set, int repeats);

}  // namespace corvo::bench
