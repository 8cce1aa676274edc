#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds corvo, gathers photographs whose licenses allow any use (gather_photographs.sh) and learns
# the 256 binary tests of descriptors from them. The same photographs give the same file. Learning
# takes minutes and 1 GB of memory.
#
#   learn_pattern.sh [FILE]
#
#   FILE   the file to write; default orb/free_pattern.inc
set -euo pipefail

usage() { sed -n '3,9s/^# \{0,1\}//p' "$0"; }

case ${1:-} in
  -h | --help) usage; exit 0 ;;
esac
[ $# -le 1 ] || { usage >&2; exit 1; }
file=$(realpath "${1:-$(dirname "${BASH_SOURCE[0]}")/../orb/free_pattern.inc}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

photographs=build/release/photographs
scripts/install_dependencies.sh
cmake --preset release
cmake --build --preset release --target corvo
rm -rf "$photographs"
scripts/gather_photographs.sh "$photographs"
build/release/apps/corvo learn "$photographs" -o "$file" --force \
  --source "CC0, CC-BY and public-domain photographs listed in scripts/photographs.tsv"
