#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the files of a release of the last commit, in a clean clone of it: the source archive, the
# wheel, the Debian packages, a bill of materials and the checksums of all, in the folder
# OUTPUT_FOLDER/corvo-VERSION (dist/corvo-VERSION). Refuses changes that are not committed, and a
# version that CHANGELOG.md and CITATION.cff do not name with the same date, or the recipe for conda
# not at all.
#
#   release.sh [--unreleased] [--check] [OUTPUT_FOLDER]
#
#   --unreleased   for a trial: the version needs no date yet
#   --check        refuses or not, and makes nothing
set -euo pipefail

usage() { sed -n '3,12s/^# \{0,1\}//p' "$0"; }

fail() {
  echo "release.sh: $1" >&2
  exit 1
}

in_git() { git -c safe.directory="$PWD" "$@"; }

# The value of a field at the first level of CITATION.cff.
citation() { sed -nE "s/^$1: \"?([^\"]*)\"?$/\1/p" CITATION.cff; }

require_clean_tree() {
  local changes
  changes=$(in_git status --porcelain)
  [ -z "$changes" ] || fail "there are changes that are not committed:
$changes"
}

require_version_is_named() {
  local heading date
  [ "$(citation version)" = "$version" ] ||
    fail "CITATION.cff names version \"$(citation version)\", CMakeLists.txt $version"
  grep -qxF "  version: \"$version\"" conda/recipe.yaml ||
    fail "conda/recipe.yaml does not have version $version"
  heading=$(grep -m 1 '^## ' CHANGELOG.md)
  [[ $heading =~ ^"## $version, "(.+)$ ]] ||
    fail "the first section of CHANGELOG.md is \"$heading\", not \"## $version, DATE\""
  date=${BASH_REMATCH[1]}
  ! $unreleased || return 0
  [[ $date =~ ^20[0-9]{2}-[0-9]{2}-[0-9]{2}$ ]] ||
    fail "CHANGELOG.md has no date for version $version: \"$heading\""
  [ "$(citation date-released)" = "$date" ] ||
    fail "CITATION.cff has the date \"$(citation date-released)\", CHANGELOG.md $date"
}

make_source_archive() {
  git -C "$clone" archive --format=tar --prefix="corvo-$version/" HEAD |
    gzip --best --no-name >"$release/corvo-$version.tar.gz"
}

make_binaries() (
  cd "$clone"
  cmake --preset release -D CORVO_BUILD_TESTS=OFF -D CORVO_BUILD_BENCHMARKS=OFF
  scripts/build_packages.sh "$release"
  scripts/make_sbom.sh build/release/apps/corvo >"$release/corvo-$version.spdx.json"
  scripts/build_wheel.sh "$release"
)

unreleased=false check=false output=dist
while [ $# -gt 0 ]; do
  case $1 in
    --unreleased) unreleased=true ;;
    --check) check=true ;;
    -h | --help) usage; exit 0 ;;
    -*) usage >&2; exit 1 ;;
    *) output=$1 ;;
  esac
  shift
done
output=$(realpath -m "$output")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
version=$(sed -nE 's/^project\(corvo VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
require_clean_tree
require_version_is_named
! $check || exit 0

[ ! -e "$output/corvo-$version" ] || fail "$output/corvo-$version exists"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
clone=$work/corvo release=$work/corvo-$version
in_git clone --quiet . "$clone"
SOURCE_DATE_EPOCH=$(in_git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
mkdir "$release"
make_source_archive
make_binaries
(cd "$release" && sha256sum -- * | tee SHA256SUMS)
mkdir -p "$output"
mv "$release" "$output"
echo "Release of version $version, commit $(in_git rev-parse --short HEAD): $output/corvo-$version"
