// SPDX-License-Identifier: MIT
#include <numeric>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/benchmarks.h"
#include "bench/paired_times.h"
#include "bench/staged_extractor.h"
#include "orb/error.h"
#include "orb/kernels/instruction_sets.h"
#include "vo/math/percentile.h"

namespace corvo::bench {
namespace {

std::vector<orb::Keypoint> KeypointsOf(const std::vector<orb::Features>& levels) {
  std::vector<orb::Keypoint> all;
  for (const orb::Features& level : levels) {
    all.insert(all.end(), level.keypoints.begin(), level.keypoints.end());
  }
  return all;
}

void CheckEqualKeypoints(StagedExtractor& staged, int num_features, const cv::Mat& image) {
  orb::ExtractorOptions options;
  options.num_features = num_features;
  staged.Extract(image);
  const orb::Features expected = orb::Extractor(options).Extract(image);
  if (KeypointsOf(staged.features()) == expected.keypoints) return;
  throw Error("keypoints found stage by stage are not those of orb::Extractor");
}

void RunStages(ImageSet& set, int num_features, benchmark::State& state) {
  const std::vector<cv::Mat>& images = set.Images();
  StagedExtractor extractor(num_features);
  CheckEqualKeypoints(extractor, num_features, images.front());
  std::vector<LeastTimes> times(kStages.size(), LeastTimes(set.count()));
  int visit = 0;
  for (auto _ : state) {
    const int item = visit++ % set.count();
    const StageTimes ms = extractor.Extract(images[item]);
    for (std::size_t i = 0; i < ms.size(); ++i) times[i].Add(item, ms[i]);
    state.SetIterationTime(std::accumulate(ms.begin(), ms.end(), 0.0) / 1000);
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    state.counters[kStages[i]] = Percentile(times[i].ms(), 50);
  }
  state.SetLabel(set.Source());
}

void RegisterStagesOf(ImageSet& set, int num_features, int repeats) {
  const std::string instruction_set = orb::kernels::InstructionSets().front();
  const std::string name =
      fmt::format("{}, {} keypoints, stages/{}", set.name(), num_features, instruction_set);
  benchmark::RegisterBenchmark(
      name.c_str(),
      [&set, num_features](benchmark::State& state) { RunStages(set, num_features, state); })
      ->Iterations(set.count() * repeats)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void RegisterStages(ImageSets& images, int repeats) {
  RegisterStagesOf(images.vga, 1000, repeats);
  RegisterStagesOf(images.kitti, 2000, repeats);
  RegisterStagesOf(images.euroc, 1000, repeats);
  RegisterStagesOf(images.full_hd, 2000, repeats);
}

}  // namespace corvo::bench
