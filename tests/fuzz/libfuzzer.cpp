// SPDX-License-Identifier: MIT
// The program of one target, CORVO_FUZZ_FUNCTION.
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  cv::setNumThreads(1);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  corvo::fuzz::CORVO_FUZZ_FUNCTION({data, size});
  return 0;
}
