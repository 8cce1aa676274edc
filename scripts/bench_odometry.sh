#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the benchmarks and runs the odometry on the recorded sequences
# under every perturbation, then measures its cost beside cv::ORB's. Writes the tables as
# build/release/bench_odometry.md and every figure as build/release/bench_odometry.json.
#
#   bench_odometry.sh [ARGUMENT...]     for corvo_odometry_bench: --refine, --rendered,
#                                       --scenarios 'KITTI 05'
#
# Pictures are looked for in the folder that CORVO_DATA names. The costs need an idle machine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
cmake --preset release -DCORVO_BUILD_BENCHMARKS=ON
cmake --build --preset release --target corvo_odometry_bench
bench=build/release/bench/odometry/corvo_odometry_bench
{
  "$bench" --json build/release/bench_odometry.json "$@"
  echo
  "$bench" --cost
} | tee build/release/bench_odometry.md
