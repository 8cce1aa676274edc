#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds the Python package and the benchmarks, runs the odometry on the
# recorded sequences under every perturbation, as the plan bench/odometry.yaml names them, and then
# measures its cost beside cv::ORB's. Writes the tables as build/bench_odometry.md; the folder of the
# sweep is build/bench_odometry.
#
#   bench_odometry.sh [ARGUMENT...]     for corvo sweep: --workers 4, --baseline rows.parquet
#
# Images are looked for in the folder that CORVO_DATA names. The costs need an idle machine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh --development
rm -rf build/bench_odometry_wheel
scripts/build_wheel.sh build/bench_odometry_wheel
/usr/bin/python3 -m venv build/bench_odometry_venv
build/bench_odometry_venv/bin/pip install --quiet --disable-pip-version-check \
  "$(echo build/bench_odometry_wheel/corvo-*.whl)[sweep]"
cmake --preset release -DCORVO_BUILD_BENCHMARKS=ON
cmake --build --preset release --target corvo_odometry_bench

build/bench_odometry_venv/bin/corvo sweep bench/odometry.yaml -o build/bench_odometry "$@"
{
  cat build/bench_odometry/medians.md
  echo
  build/release/bench/odometry/corvo_odometry_bench --cost
} | tee build/bench_odometry.md
