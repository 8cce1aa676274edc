# SPDX-License-Identifier: MIT
# The headers of dependencies that most sources include. Parsing them once for each target saves
# clang a fifth of the compilation under sanitizers; g++ gains less than a tenth by it. Every source
# still includes what it uses, as builds without the option show.
option(CORVO_PRECOMPILE_HEADERS "Parse the headers of dependencies once for each target" OFF)

set(corvo_library_headers
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <set>
  <span> <string> <string_view> <unordered_map> <utility> <vector>
  <Eigen/Cholesky> <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <fmt/format.h> <opencv2/core.hpp>)
set(corvo_command_headers
  ${corvo_library_headers} <fstream> <sstream> <nlohmann/json.hpp> <spdlog/spdlog.h>)
set(corvo_test_headers <gmock/gmock.h> <gtest/gtest.h>)

# Precompiles headers for a target, which must have their include directories.
function(corvo_precompile_headers target)
  if(CORVO_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
