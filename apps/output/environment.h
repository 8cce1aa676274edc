// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace corvo {

/// What a result does not depend on but its timings do: versions, compiler, processor.
nlohmann::ordered_json DescribeMachine();

/// The same and, of a run, `threads`, peak memory of this process, `elapsed_s`.
nlohmann::ordered_json DescribeEnvironment(int threads, double elapsed_s);

}  // namespace corvo
