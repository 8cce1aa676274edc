// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/output/environment.h"
#include "bench/benchmarks.h"
#include "bench/table_reporter.h"
#include "orb/kernels/instruction_sets.h"

namespace corvo::bench {
namespace {

constexpr const char* kHelp =
    R"(corvo_bench [--images N] [--repeats N] [--benchmark_filter=REGEX] [--benchmark_out=FILE]

Times corvo against OpenCV, image by image, and prints a Markdown table.
  --images N    images of each size (default 100)
  --repeats N   visits to each; the least time counts (default 5)
and the options of Google Benchmark: --benchmark_out writes JSON.
)";

/// Adds the machine and its instruction sets to the context of the JSON output.
void DescribeEnvironment() {
  const auto environment = DescribeMachine();
  for (const auto& [key, value] : environment.items()) {
    benchmark::AddCustomContext(key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  std::string names;
  for (const std::string& name : orb::kernels::InstructionSets()) {
    names += (names.empty() ? "" : " ") + name;
  }
  benchmark::AddCustomContext("instruction_sets", names);
}

int Main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv, [] { fmt::print("{}", kHelp); });
  int num_images = 100;
  int repeats = 5;
  CLI::App app;
  app.add_option("--images", num_images)->check(CLI::Range(1, 10000));
  app.add_option("--repeats", repeats)->check(CLI::Range(1, 10000));
  CLI11_PARSE(app, argc, argv);

  DescribeEnvironment();
  ImageSets images = MakeImageSets(num_images);
  RegisterExtraction(images, repeats);
  RegisterFast(images, repeats);
  RegisterMatching(images, repeats);
  RegisterStages(images, repeats);
  TableReporter reporter;
  return benchmark::RunSpecifiedBenchmarks(&reporter) > 0 ? 0 : 1;
}

}  // namespace
}  // namespace corvo::bench

int main(int argc, char** argv) {
  try {
    return corvo::bench::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "corvo_bench: {}\n", error.what());
    return 1;
  }
}
