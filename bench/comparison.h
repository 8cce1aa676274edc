// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace corvo::bench {

/// Does its work on an item, from 0 on, and returns how many results there are. It keeps what it
/// can reuse.
using Work = std::function<std::size_t(int item)>;

/// corvo and what it is measured against.
struct Contenders {
  Work contender;
  Work baseline;
  std::string images;  ///< Where those that they work on come from.
};

struct Comparison {
  std::string title;
  int items = 0;
  int threads = 1;  ///< OpenCV's. The time of one is its processor time, that of more wall time.
  std::function<Contenders()> prepare;  ///< Called once, with the instruction set in use.
};

/// Registers a comparison with Google Benchmark as "title/instruction_set". An iteration is a visit
/// to one item by both; who goes first alternates, and with it who finds the item in the cache.
/// Each item is visited `repeats` times, all others in between, and counts with the least time of
/// each contender. The counters are those of PairedSummary and the mean number of `results` and of
/// `baseline_results`.
void Register(const Comparison& comparison, const std::string& instruction_set, int repeats);

}  // namespace corvo::bench
