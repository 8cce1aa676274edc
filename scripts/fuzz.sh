#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the fuzz targets (clang, libFuzzer, address and undefined-behavior sanitizers) and runs
# each of them, two at a time.
#
#   fuzz.sh SECONDS [TARGET...]     SECONDS each; every target in tests/fuzz/corpus by default
#
# A target first runs all inputs that are kept in tests/fuzz/corpus/TARGET, then changes them at
# random. New inputs go to build/fuzz/corpus/TARGET, so that the next run goes on from them. An input
# that breaks a promise ends its target, is left in build/fuzz/findings and printed at the end; when
# its cause is mended, it belongs into tests/fuzz/corpus, which the ordinary tests run.
#
# CORVO_FUZZ_BUILD names another build folder, built with -DCORVO_BUILD_FUZZERS=ON.
# CORVO_FUZZ_SEED, a positive number, makes the changes the same ones in every run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [ $# -eq 0 ] || ! [[ $1 =~ ^[0-9]+$ ]]; then
  sed -n '3,15s/^# \{0,1\}//p' "$0" >&2
  exit 1
fi
export seconds=$1
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(ls tests/fuzz/corpus)

export build=${CORVO_FUZZ_BUILD:-build/fuzz}
[ -n "${CORVO_FUZZ_BUILD:-}" ] || cmake --preset fuzz
cmake --build "$build" --target "${targets[@]/#/fuzz_}"

# The folder of scratch files: in memory where there is such a place.
if [ -z "${TMPDIR:-}" ] && [ -w /dev/shm ]; then export TMPDIR=/dev/shm; fi
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=1}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}

run_target() {
  local target=$1 log
  mkdir -p "$build/corpus/$target" "$build/findings"
  log=$build/findings/$target.log
  if "$build/tests/fuzz/fuzz_$target" -seed="${CORVO_FUZZ_SEED:-0}" -max_total_time="$seconds" \
    -max_len=2000 -timeout=25 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$build/findings/$target-" \
    "$build/corpus/$target" "tests/fuzz/corpus/$target" >"$log" 2>&1; then
    awk -v name="$target" '/number_of_executed_units/ { runs = $2 }
      / cov: / { for (i = 1; i < NF; ++i) if ($i == "cov:") cov = $(i + 1) }
      END { printf "%-14s %9d inputs, %5d code blocks reached\n", name, runs, cov }' "$log"
  else
    printf '%-14s FAILED, see %s:\n' "$target" "$log"
    grep -E 'broken promise|ERROR:|SUMMARY|runtime error|Test unit written|Base64' "$log" | head -n 6
    return 1
  fi
}
export -f run_target
printf '%s\0' "${targets[@]}" | xargs -0 -n 1 -P 2 bash -c 'run_target "$0"'
