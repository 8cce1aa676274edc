// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "orb/lsh_index.h"
#include "orb/matcher.h"

namespace corvo::bench {

/// Every time is processor time of one thread; the least of `repeats`.

struct ScanResult {
  std::vector<orb::Nearest> nearest;  ///< By query.
  double query_ms = 0;
  double memory_mb = 0;
};

/// Exact scan of the collection, `batch` queries at a time.
ScanResult MeasureScan(std::span<const orb::Descriptor> collection,
                       std::span<const orb::Descriptor> queries, int batch, int repeats);

struct IndexResult {
  orb::LshIndexOptions options;
  double build_s = 0;
  double memory_mb = 0;
  double recall = 0;  ///< Share of queries whose nearest is as near as in the scan.
  double mean_ms = 0;
  double p50_ms = 0;
  double p99_ms = 0;
};

/// An index of the collection, one query at a time; `exact` is what the scan found.
IndexResult MeasureIndex(std::span<const orb::Descriptor> collection,
                         std::span<const orb::Descriptor> queries,
                         std::span<const orb::Nearest> exact, const orb::LshIndexOptions& options,
                         int repeats);

/// Save() and Load() of an index of the collection in a temporary file, wall time.
struct FileResult {
  double save_s = 0;
  double load_s = 0;
  double size_mb = 0;
};
FileResult MeasureFile(std::span<const orb::Descriptor> collection);

}  // namespace corvo::bench
