// SPDX-License-Identifier: MIT
#include "apps/output/environment.h"

#include <fstream>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <Eigen/Core>
#include <opencv2/core/version.hpp>

#include "apps/system/peak_memory.h"

namespace corvo {
namespace {

std::string CpuModel() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string Compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

}  // namespace

nlohmann::ordered_json DescribeMachine() {
  nlohmann::ordered_json json;
  json["corvo"] = CORVO_VERSION;
  json["opencv"] = CV_VERSION;
  json["eigen"] =
      fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  json["ceres"] = CORVO_CERES_VERSION;
  json["compiler"] = Compiler();
  json["build_type"] = CORVO_BUILD_TYPE;
  json["cpu"] = CpuModel();
  json["cpu_threads"] = std::thread::hardware_concurrency();
  return json;
}

nlohmann::ordered_json DescribeEnvironment(int threads, double elapsed_s) {
  nlohmann::ordered_json json = DescribeMachine();
  json["threads"] = threads;
  json["peak_memory_mb"] = PeakMemoryMb();
  json["elapsed_s"] = elapsed_s;
  return json;
}

}  // namespace corvo
