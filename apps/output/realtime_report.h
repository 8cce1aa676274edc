// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace corvo {

/// How a run kept up with images that came in real time.
struct RealtimeReport {
  int num_dropped = 0;  ///< Images that were replaced by newer ones before they were processed.
  /// For each processed image, the time from when it was due until its pose was known.
  std::vector<double> latencies_ms;
};

/// Returns the number of dropped images and, if any was processed, the median, the 99th percentile
/// and the largest of the latencies.
nlohmann::ordered_json ToJson(const RealtimeReport& report);

/// Returns the same as a line like "real time: 300 images, 2 dropped; latency: median 5.1 ms,
/// p99 9.8 ms, max 12.4 ms".
std::string ToText(const RealtimeReport& report);

}  // namespace corvo
