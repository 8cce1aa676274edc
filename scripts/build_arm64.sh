#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Cross-compiles corvo for ARM64 against Debian's arm64 packages, runs the tests of orb/ and vo/ under
# qemu's user emulation, and makes the Debian packages: OUTPUT_FOLDER/*_arm64.deb, by default in the
# folder dist. All this is done in a root of its own with this system's release of Debian, which is
# made once, so that this system gets no packages of another architecture. Needs root and debootstrap.
#
#   build_arm64.sh [--tests-only] [OUTPUT_FOLDER]
#
#   CORVO_ARM64_ROOTS   the folder that the root lies in; default ~/.cache/corvo (XDG_CACHE_HOME)
#   CORVO_DATA          real images for the tests, as elsewhere
set -euo pipefail

host_packages=(cmake crossbuild-essential-arm64 dpkg-dev file ninja-build qemu-user-static
  libcli11-dev libeigen3-dev nlohmann-json3-dev)
arm64_packages=(libopencv-dev libceres-dev libtbb-dev libhwy-dev libyaml-cpp-dev libfmt-dev
  libspdlog-dev libgtest-dev libgmock-dev)

usage() { sed -n '3,11s/^# \{0,1\}//p' "$0"; }

# Runs a command in the root, as in a container: the mounts end with it.
in_root() {
  # shellcheck disable=SC2016
  unshare --mount --propagation private bash -c '
    set -e
    root=$1 checkout=$2 data=$3
    shift 3
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --bind "$checkout" "$root/corvo"
    [ ! -d "$data" ] || mount --bind "$data" "$root/data"
    exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive CORVO_DATA=/data SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" \
      chroot "$root" env --chdir=/corvo "$@"' bash "$root" "$PWD" "${CORVO_DATA:-}" "$@" </dev/null
}

# The root uses this system's sources of packages and its settings of apt.
make_root() {
  local release mirror
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "Codename: $release" |
    head -n 1)
  rm -rf "$root"
  debootstrap --variant=minbase --include=ca-certificates "$release" "$root" "$mirror"
  cp -r /etc/apt/sources.list* /etc/apt/apt.conf.d "$root/etc/apt/"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  cp -r /etc/ssl/certs/. "$root/etc/ssl/certs/"
  mkdir "$root/corvo" "$root/data"
  in_root dpkg --add-architecture arm64
  in_root apt-get -q update
  in_root apt-get install -y -q -o Dpkg::Use-Pty=0 --no-install-recommends \
    "${host_packages[@]}" "${arm64_packages[@]/%/:arm64}"
  touch "$root/.complete"
}

run_tests() {
  local program
  in_root cmake --build build/arm64 --target test_kernels test_orb test_vo
  for program in orb/test_kernels orb/test_orb vo/test_vo; do
    in_root qemu-aarch64-static "build/arm64/tests/$program" --gtest_brief=1
  done
}

# Tracks a rendered sequence with the installed command.
use_package() {
  local corvo=(in_root qemu-aarch64-static /usr/bin/corvo) work=build/arm64/room
  in_root apt-get install -y -q --no-install-recommends ./build/arm64/packages/corvo_*_arm64.deb
  "${corvo[@]}" synth room -o $work --frames 20
  "${corvo[@]}" run $work --camera $work/camera.yaml --gt $work/groundtruth.txt -o $work/result
  in_root apt-get purge -y -q corvo:arm64
}

make_packages() {
  in_root scripts/build_packages.sh build/arm64/packages build/arm64
  use_package
  mkdir -p "$output"
  mv build/arm64/packages/*_arm64.deb "$output"
}

tests_only=false output=dist
while [ $# -gt 0 ]; do
  case $1 in
    --tests-only) tests_only=true ;;
    -h | --help) usage; exit 0 ;;
    -*) usage >&2; exit 1 ;;
    *) output=$1 ;;
  esac
  shift
done
output=$(realpath -m "$output")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "build_arm64.sh: needs root and debootstrap" >&2
  exit 1
fi
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -c safe.directory="$PWD" log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH
key=$({ cat /etc/os-release; echo "${host_packages[*]} ${arm64_packages[*]}"; } | sha256sum | cut -c 1-16)
root=$(realpath -m "${CORVO_ARM64_ROOTS:-${XDG_CACHE_HOME:-$HOME/.cache}/corvo}")/arm64-root-$key
[ -e "$root/.complete" ] || make_root

rm -rf build/arm64/packages build/arm64/room
in_root cmake --preset arm64 -D CORVO_WERROR=ON
run_tests
$tests_only || make_packages
