#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Cross-compiles the SIMD kernels of orb/ for ARM64 with their tests, which compare NEON with the scalar
# twins, and runs these under qemu's user emulation. Highway is that of Debian's arm64 packages,
# which are unpacked, not installed. build_arm64.sh runs all tests of orb/ and vo/.
#
#   test_arm64_kernels.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Compiles a file. The warnings of GoogleTest's own files are not ours.
compile() {
  local warnings=(-Wall -Wextra -Werror)
  [[ $1 != /* ]] || warnings=(-w)
  aarch64-linux-gnu-g++ -std=c++20 -O3 -ffp-contract=off "${warnings[@]}" \
    -I . -I "$work/root/usr/include" -I /usr/src/googletest/googletest \
    -I /usr/src/googletest/googletest/include \
    -I /usr/src/googletest/googlemock -I /usr/src/googletest/googlemock/include \
    -DHWY_SHARED_DEFINE "-DHWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)" \
    -c "$1" -o "$work/$(basename "$1").o"
}

# The system's configuration and state of apt stay as they are.
fetch_highway() {
  mkdir -p "$work/lists/partial" "$work/packages" "$work/root"
  local apt=(apt-get -qq -o APT::Architecture=arm64 -o APT::Architectures=arm64
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root)
  "${apt[@]}" update
  (cd "$work/packages" && "${apt[@]}" download libhwy-dev libhwy1)
  for package in "$work"/packages/*.deb; do dpkg-deb --extract "$package" "$work/root"; done
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export -f compile
export work
fetch_highway
printf '%s\0' orb/kernels/*.cpp orb/hamming.cpp tests/orb/kernels/*_test.cpp \
  /usr/src/googletest/googlemock/src/gmock{-all,_main}.cc \
  /usr/src/googletest/googletest/src/gtest-all.cc |
  xargs -0 -n 1 -P "$(nproc)" bash -c 'compile "$0"'
libraries=$work/root/usr/lib/aarch64-linux-gnu
aarch64-linux-gnu-g++ "$work"/*.o -L "$libraries" -lhwy -o "$work/test_kernels"
qemu-aarch64-static -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH="$libraries" \
  "$work/test_kernels" --gtest_brief=1
