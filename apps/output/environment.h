// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace corvo {

/// Returns the library versions, compiler and processor, which affect timings but not results.
nlohmann::ordered_json DescribeMachine();

/// Returns DescribeMachine() with `threads`, the peak memory of this process, and `elapsed_s`.
nlohmann::ordered_json DescribeEnvironment(int threads, double elapsed_s);

}  // namespace corvo
