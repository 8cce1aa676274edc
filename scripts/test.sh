#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds corvo and its tests, and runs every test.
#
#   test.sh [CMAKE_ARGUMENT...]     such as -DCORVO_WERROR=ON
#
# Tests on real images look for them in the folder that CORVO_DATA names; without the images they
# are skipped and listed at the end.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
cmake --preset release "$@"
cmake --build --preset release
ctest --preset release --parallel 2 --no-tests=error
