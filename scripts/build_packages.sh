#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the Debian packages corvo and libcorvo-dev from a build of the preset release (or BUILD),
# which it brings up to date: OUTPUT_FOLDER/*.deb, by default in the folder dist.
#
#   build_packages.sh [OUTPUT_FOLDER [BUILD]]
#
#   SOURCE_DATE_EPOCH   the time in the packages; default: that of the last commit, or now
set -euo pipefail

for program in dpkg-shlibdeps file; do
  command -v "$program" >/dev/null && continue
  echo "build_packages.sh: $program is not installed (Debian: apt-get install dpkg-dev file)" >&2
  exit 1
done

output=$(realpath -m "${1:-dist}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$(realpath -m "${2:-build/release}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [ ! -f "$build/CMakeCache.txt" ]; then cmake --preset release -B "$build"; fi
cmake --build "$build" --target corvo_documentation corvo_orb corvo_vo corvo_codecs_module
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -c safe.directory="$PWD" log -1 --format=%ct 2>/dev/null || date +%s)}
export SOURCE_DATE_EPOCH
(cd "$build" && cpack -G DEB -B "$work")
mkdir -p "$output"
mv "$work"/*.deb "$output"
