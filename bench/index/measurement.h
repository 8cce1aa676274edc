// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "orb/lsh_index.h"
#include "orb/matcher.h"

namespace corvo::bench {

/// The result of an exact scan. The time is processor time of one thread, the least of `repeats`.

struct ScanResult {
  std::vector<orb::Nearest> nearest;  ///< One per query.
  double query_ms = 0;
  double memory_mb = 0;
};

/// Measures an exact scan of the collection with `batch` queries at a time.
ScanResult MeasureScan(std::span<const orb::Descriptor> collection,
                       std::span<const orb::Descriptor> queries, int batch, int repeats);

struct IndexResult {
  orb::LshIndexOptions options;
  double build_s = 0;
  double memory_mb = 0;
  double recall = 0;  ///< Share of queries whose result is as near as in the scan.
  double mean_ms = 0;
  double p50_ms = 0;
  double p99_ms = 0;
};

/// Measures an index of the collection with one query at a time; `exact` is the result of the scan.
/// The times are processor times of one thread; those of queries are the least of `repeats`.
IndexResult MeasureIndex(std::span<const orb::Descriptor> collection,
                         std::span<const orb::Descriptor> queries,
                         std::span<const orb::Nearest> exact, const orb::LshIndexOptions& options,
                         int repeats);

/// Wall times of Save() and Load() of an index in a temporary file, and the size of the file.
struct FileResult {
  double save_s = 0;
  double load_s = 0;
  double size_mb = 0;
};
FileResult MeasureFile(std::span<const orb::Descriptor> collection);

}  // namespace corvo::bench
