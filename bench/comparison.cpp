// SPDX-License-Identifier: MIT
#include "bench/comparison.h"

#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>

#include "bench/clocks.h"
#include "bench/paired_times.h"
#include "orb/kernels/instruction_sets.h"

namespace corvo::bench {
namespace {

/// One of two contenders and its times.
class Timed {
 public:
  Timed(const Work& work, int items, double (*now_ms)())
      : work_(work), now_ms_(now_ms), times_(items) {}

  /// Runs the work on an item and returns its time, ms.
  double Visit(int item) {
    const double start_ms = now_ms_();
    const std::size_t results = work_(item);
    const double ms = now_ms_() - start_ms;
    times_.Add(item, ms);
    results_ += static_cast<double>(results);
    return ms;
  }

  const LeastTimes& times() const { return times_; }
  /// Returns the number of results, summed over all visits.
  double results() const { return results_; }

 private:
  const Work& work_;
  double (*now_ms_)();
  LeastTimes times_;
  double results_ = 0;
};

void Report(const Timed& contender, const Timed& baseline, benchmark::State& state) {
  const PairedSummary summary = Summarize(contender.times(), baseline.times());
  const auto visits = static_cast<double>(state.iterations());
  state.counters["ms"] = summary.ms;
  state.counters["p99_ms"] = summary.p99_ms;
  state.counters["baseline_ms"] = summary.baseline_ms;
  state.counters["baseline_p99_ms"] = summary.baseline_p99_ms;
  state.counters["ratio"] = summary.ratio;
  state.counters["ratio_p10"] = summary.ratio_p10;
  state.counters["ratio_p90"] = summary.ratio_p90;
  state.counters["results"] = contender.results() / visits;
  state.counters["baseline_results"] = baseline.results() / visits;
}

void Run(const Contenders& contenders, int items, double (*now_ms)(), benchmark::State& state) {
  Timed contender(contenders.contender, items, now_ms);
  Timed baseline(contenders.baseline, items, now_ms);
  int visit = 0;
  for (auto _ : state) {
    const int item = visit % items;
    const bool contender_first = (item + visit / items) % 2 == 0;
    if (!contender_first) baseline.Visit(item);
    state.SetIterationTime(contender.Visit(item) / 1000);
    if (contender_first) baseline.Visit(item);
    ++visit;
  }
  Report(contender, baseline, state);
}

}  // namespace

void Register(const Comparison& comparison, const std::string& instruction_set, int repeats) {
  const auto run = [comparison, instruction_set](benchmark::State& state) {
    const orb::kernels::UseInstructionSet use(instruction_set);
    cv::setNumThreads(comparison.threads);
    const Contenders contenders = comparison.prepare();
    state.SetLabel(contenders.images);
    Run(contenders, comparison.items, comparison.threads == 1 ? ThreadTimeMs : WallTimeMs, state);
  };
  benchmark::RegisterBenchmark((comparison.title + "/" + instruction_set).c_str(), run)
      ->Iterations(comparison.items * repeats)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace corvo::bench
