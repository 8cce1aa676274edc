#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the tests of code that starts threads with clang's thread sanitizer and runs them.
#
#   check_threads.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --preset tsan
cmake --build --preset tsan
export TSAN_OPTIONS="suppressions=$PWD/tests/threads/tsan_suppressions.txt:second_deadlock_stack=1"
build/tsan/tests/threads/test_threads "$@"
