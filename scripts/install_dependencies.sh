#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what corvo needs to build and to run, on Debian 12, Debian 13 and Ubuntu 24.04. Installs
# only what is missing, says so first, and needs neither root nor a network when nothing is.
#
#   install_dependencies.sh [--development]
#
#   --development   also clang 14, clang-format 14, clang-tidy 14, codespell, doxygen, fish and zsh, in
#                   which the tests try completions, Chromium, in which they open reports, dpkg-dev,
#                   file and lintian, with which packages are built and checked, a cross compiler for
#                   ARM64 and qemu, nasm and Python's headers, with which the wheel is built, and in
#                   the folder .venv evo, pycolmap and gtsam (PyPI), with which they compare measures,
#                   read exported models and close loops, and MkDocs with its theme Material (PyPI),
#                   which build the documentation site; continuous integration uses these
set -euo pipefail

# libopencv-dev whole: its component packages carry no CMake files.
packages=(g++ cmake ninja-build libeigen3-dev libopencv-dev libceres-dev libtbb-dev libhwy-dev
  libcli11-dev libyaml-cpp-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libgtest-dev libgmock-dev
  libbenchmark-dev gnuplot-nox)
development=(chromium clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14 codespell doxygen
  dpkg-dev file fish g++-aarch64-linux-gnu lintian nasm python3-dev python3-venv qemu-user-static zsh)
python_packages=(evo==1.38.1 pycolmap==4.2.1 gtsam==4.3.0 mkdocs==1.6.1 mkdocs-material==9.8.2)

usage() { sed -n '3,14s/^# \{0,1\}//p' "$0"; }

fail_unsupported() {
  cat >&2 <<'TEXT'
install_dependencies.sh: this system has no apt-get and dpkg; it can install on Debian 12, Debian 13
and Ubuntu 24.04 only. Install these yourself, with their headers and CMake files, and build with
`cmake --preset release && cmake --build --preset release`:
  a C++20 compiler (g++ 12 or clang 14, or later), CMake 3.22 or later, Ninja,
  Eigen 3.4, OpenCV 4.6 or later (core imgproc imgcodecs videoio features2d calib3d, and stitching
  for the tests), Ceres 2.1 or later, TBB, Highway 1.0.3 or later, CLI11, yaml-cpp, fmt, spdlog,
  nlohmann-json, GoogleTest with gmock, Google Benchmark, and gnuplot for pictures
TEXT
  exit 1
}

is_installed() {
  [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "install_dependencies.sh: needs root, and there is no sudo; as root, run:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
}

install_python_packages() {
  local venv installed package
  venv=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/.venv
  installed=$("$venv/bin/pip" freeze 2>/dev/null) || installed=
  for package in "${python_packages[@]}"; do
    grep -qxF "$package" <<<"$installed" || installed=
  done
  [ -z "$installed" ] || return 0
  echo "Installing ${python_packages[*]} in .venv"
  /usr/bin/python3 -m venv --clear "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check "${python_packages[@]}"
}

with_python=false
for argument in "$@"; do
  case $argument in
    --development) packages+=("${development[@]}") with_python=true ;;
    -h | --help) usage; exit 0 ;;
    *) echo "install_dependencies.sh: unknown argument $argument" >&2; usage >&2; exit 1 ;;
  esac
done
command -v apt-get >/dev/null && command -v dpkg-query >/dev/null || fail_unsupported

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "All ${#packages[@]} packages that corvo needs are installed."
else
  echo "Installing ${#missing[@]} of ${#packages[@]} packages, with what they depend on: ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q -o Dpkg::Use-Pty=0 \
    --no-install-recommends \
    "${missing[@]}"
fi
if $with_python; then install_python_packages; fi
