#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the benchmarks and measures the camera's estimate: how honest its
# sigmas are on rendered films whose camera is known exactly, how soon KITTI's distortion is known,
# and whether what one sequence tells of a camera serves another. Writes the tables as
# build/release/bench_calibration.md, every figure as build/release/bench_calibration.json and a
# picture of k1 over the frames as build/release/calibration_k1.png.
#
#   bench_calibration.sh [ARGUMENT...]     for corvo_calibration_bench: --refine, --rendered,
#                                          --recorded, --runs 20
#
# Pictures are looked for in the folder that CORVO_DATA names.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
cmake --preset release -DCORVO_BUILD_BENCHMARKS=ON
cmake --build --preset release --target corvo_calibration_bench
build/release/bench/calibration/corvo_calibration_bench \
  --json build/release/bench_calibration.json --plot build/release/calibration_k1.png "$@" |
  tee build/release/bench_calibration.md
