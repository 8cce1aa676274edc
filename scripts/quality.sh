#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds, and measures corvo's features beside OpenCV's, then its index of
# descriptors against the exact scan: the tables and charts of docs/features.md. Writes them, and
# every figure as JSON, to build/release/quality. Takes some minutes.
#
#   quality.sh [ARGUMENT...]     for corvo_quality: --oxford wall bark, --features 500, --short
#
# Pictures are looked for in the folder that CORVO_DATA names.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=build/release/quality
scripts/install_dependencies.sh
cmake --preset release -DCORVO_BUILD_BENCHMARKS=ON
cmake --build --preset release --target corvo_quality corvo_index_bench
build/release/bench/quality/corvo_quality --output "$folder" "$@"
build/release/bench/index/corvo_index_bench --json "$folder/index.json" | tee "$folder/index.md"
