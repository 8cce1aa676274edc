#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the benchmarks, compares corvo with OpenCV in one process and
# prints the README's table. Writes it as build/release/bench.md, and all figures with what they
# were measured on as build/release/bench.json.
#
#   bench.sh [ARGUMENT...]     for corvo_bench: --images 20, --benchmark_filter='VGA.*ORB'
#
# Pictures are looked for in the folder that CORVO_DATA names; without them rendered ones are used.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
cmake --preset release -DCORVO_BUILD_BENCHMARKS=ON
cmake --build --preset release --target corvo_bench
build/release/bench/corvo_bench --benchmark_out=build/release/bench.json "$@" |
  tee build/release/bench.md
