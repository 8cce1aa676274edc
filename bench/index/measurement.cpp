// SPDX-License-Identifier: MIT
#include "bench/index/measurement.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/clocks.h"
#include "orb/kernels/nearest_two.h"
#include "vo/math/percentile.h"

namespace corvo::bench {
namespace {

constexpr double kMb = 1e6;

std::vector<orb::Nearest> Scan(std::span<const orb::Descriptor> collection,
                               std::span<const orb::Descriptor> queries, int batch) {
  std::vector<orb::Nearest> nearest;
  for (std::size_t first = 0; first < queries.size(); first += batch) {
    const std::size_t count = std::min<std::size_t>(batch, queries.size() - first);
    const auto found = orb::FindNearest(queries.subspan(first, count), collection);
    nearest.insert(nearest.end(), found.begin(), found.end());
  }
  return nearest;
}

/// Updates the least time of each query and returns the number of queries whose result is as near
/// as the exact nearest neighbor.
int CountFound(const orb::LshIndex& index, std::span<const orb::Descriptor> queries,
               std::span<const orb::Nearest> exact, std::vector<double>& least_ms) {
  int found = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double start = ThreadTimeMs();
    const std::vector<orb::Neighbor> nearest = index.FindNearest(queries[i], 1);
    least_ms[i] = std::min(least_ms[i], ThreadTimeMs() - start);
    found += !nearest.empty() && nearest[0].distance == exact[i].distance;
  }
  return found;
}

}  // namespace

ScanResult MeasureScan(std::span<const orb::Descriptor> collection,
                       std::span<const orb::Descriptor> queries, int batch, int repeats) {
  ScanResult result;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const double start = ThreadTimeMs();
    result.nearest = Scan(collection, queries, batch);
    least = std::min(least, ThreadTimeMs() - start);
  }
  result.query_ms = least / static_cast<double>(queries.size());
  result.memory_mb = (static_cast<double>(collection.size_bytes()) +
                      sizeof(orb::kernels::NearestTwoScratch) + batch * sizeof(orb::Nearest)) /
                     kMb;
  return result;
}

IndexResult MeasureIndex(std::span<const orb::Descriptor> collection,
                         std::span<const orb::Descriptor> queries,
                         std::span<const orb::Nearest> exact, const orb::LshIndexOptions& options,
                         int repeats) {
  IndexResult result;
  result.options = options;
  const double start = ThreadTimeMs();
  const orb::LshIndex index(collection, options);
  result.build_s = 1e-3 * (ThreadTimeMs() - start);
  result.memory_mb = static_cast<double>(index.memory_bytes()) / kMb;
  std::vector<double> least_ms(queries.size(), std::numeric_limits<double>::infinity());
  int found = 0;
  for (int i = 0; i < repeats; ++i) found = CountFound(index, queries, exact, least_ms);
  const auto count = static_cast<double>(queries.size());
  result.recall = found / count;
  result.mean_ms = std::accumulate(least_ms.begin(), least_ms.end(), 0.0) / count;
  result.p50_ms = Percentile(least_ms, 50);
  result.p99_ms = Percentile(least_ms, 99);
  return result;
}

FileResult MeasureFile(std::span<const orb::Descriptor> collection) {
  namespace fs = std::filesystem;
  const fs::path file = fs::temp_directory_path() / fmt::format("corvo_index_{}", getpid());
  const orb::LshIndex index(collection);
  FileResult result;
  double start = WallTimeMs();
  index.Save(file);
  result.save_s = 1e-3 * (WallTimeMs() - start);
  result.size_mb = static_cast<double>(fs::file_size(file)) / kMb;
  start = WallTimeMs();
  const orb::LshIndex loaded = orb::LshIndex::Load(file);
  result.load_s = 1e-3 * (WallTimeMs() - start);
  fs::remove(file);
  return result;
}

}  // namespace corvo::bench
