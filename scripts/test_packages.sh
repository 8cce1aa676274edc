#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests the Debian packages as their users have them: installs both with what they depend on, tracks
# a rendered sequence with the command, builds the examples with the libraries and runs them, purges
# both, and fails if anything of them is left. Changes this system, and needs root.
#
#   test_packages.sh FOLDER         which has one corvo_*.deb and one libcorvo-dev_*.deb
set -euo pipefail

fail() {
  echo "test_packages.sh: $1" >&2
  exit 1
}

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -y -q -o Dpkg::Use-Pty=0 -o APT::Sandbox::User=root "$@"
}

# Everything on this system that is named after corvo, and not in a home or a temporary folder.
named_after_corvo() { as_root find /etc /opt /usr /var -xdev -iname '*corvo*' | sort; }

expect_output() {
  local pattern=$1
  shift
  "$@" >output.txt
  grep -qE "$pattern" output.txt || fail "$(basename "$1") printed: $(cat output.txt)"
}

check_policy() {
  if ! command -v lintian >/dev/null; then
    echo "lintian is not installed: Debian's policy is not checked"
    return
  fi
  # The maintainer has no address unless CPACK_PACKAGE_CONTACT names one.
  lintian --allow-root --fail-on error,warning \
    --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$@"
}

use_command() {
  corvo --version
  corvo synth room -o room --frames 40
  corvo run room --camera room/camera.yaml --gt room/groundtruth.txt -o result
  test -s result/trajectory.tum || fail "the run has no trajectory"
  expect_output '"ATE|ate' corvo eval result --json
  corvo config /usr/share/corvo/configs/default.yaml >/dev/null
  test -s /usr/share/bash-completion/completions/corvo || fail "there is no completion for bash"
  zcat /usr/share/man/man1/corvo-run.1.gz | grep -q 'corvo run' || fail "corvo-run(1) is not there"
}

use_libraries() {
  local images=(room/rgb/*.png)
  cmake -S /usr/share/doc/libcorvo-dev/examples -B examples -D CMAKE_BUILD_TYPE=Release
  cmake --build examples --target track_images --target opencv_features
  expect_output '^[0-9]+ [-0-9.e]+ +[-0-9.e]+ +[-0-9.e]+$' examples/track_images "${images[@]}"
  expect_output '^[0-9]+ mutual matches' examples/opencv_features "${images[0]}" "${images[1]}"
}

[ $# -eq 1 ] || { sed -n '3,7s/^# \{0,1\}//p' "$0" >&2; exit 1; }
packages=("$(realpath "$1")"/corvo_*.deb "$(realpath "$1")"/libcorvo-dev_*.deb)
[ ${#packages[@]} -eq 2 ] && [ -f "${packages[0]}" ] && [ -f "${packages[1]}" ] ||
  fail "$1 does not have one package of each kind: ${packages[*]}"
before=$(named_after_corvo)
if dpkg-query --show corvo libcorvo-dev >/dev/null 2>&1; then
  fail "corvo is installed on this system, and would be purged"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

check_policy "${packages[@]}"
trap 'apt_get purge corvo libcorvo-dev >/dev/null; rm -rf "$work"' EXIT
apt_get install --no-install-recommends "${packages[@]}" cmake make
use_command
use_libraries
apt_get purge corvo libcorvo-dev
trap 'rm -rf "$work"' EXIT

left=$(comm -13 <(echo "$before") <(named_after_corvo))
[ -z "$left" ] || fail "left behind: $left"
echo "Packages: installed, used, purged; nothing is left"
