#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the API documentation of the public headers with Doxygen, in build/api/html. Warnings are
# errors.
#
#   build_api_docs.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

headers=$(sed -n 's/^  \(.*\.h\)$/\1/p' cmake/public_headers.cmake | tr '\n' ' ')
version=$(sed -nE 's/^project\(corvo VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
mkdir -p build/api
doxygen - <<EOF
@INCLUDE         = docs/Doxyfile
PROJECT_NUMBER   = $version
INPUT            = $headers
OUTPUT_DIRECTORY = build/api
EOF
echo "API documentation: $PWD/build/api/html/index.html"
