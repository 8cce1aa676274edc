// SPDX-License-Identifier: MIT
#include "apps/output/realtime_report.h"

#include <fmt/format.h>

#include "vo/math/percentile.h"

namespace corvo {

nlohmann::ordered_json ToJson(const RealtimeReport& report) {
  nlohmann::ordered_json json{{"dropped", report.num_dropped}};
  if (report.latencies_ms.empty()) return json;
  json["latency_ms"] = {{"median", Percentile(report.latencies_ms, 50)},
                        {"p99", Percentile(report.latencies_ms, 99)},
                        {"max", Percentile(report.latencies_ms, 100)}};
  return json;
}

std::string ToText(const RealtimeReport& report) {
  std::string text = fmt::format("real time: {} images, {} dropped", report.latencies_ms.size(),
                                 report.num_dropped);
  if (report.latencies_ms.empty()) return text + '\n';
  return text + fmt::format("; latency: median {:.1f} ms, p99 {:.1f} ms, max {:.1f} ms\n",
                            Percentile(report.latencies_ms, 50),
                            Percentile(report.latencies_ms, 99),
                            Percentile(report.latencies_ms, 100));
}

}  // namespace corvo
