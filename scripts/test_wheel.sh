#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests a wheel for the system's Python where its users have it: its import in a root that has glibc,
# libstdc++ and Python alone, and python/tests in a new environment, beside opencv-python.
#
#   test_wheel.sh WHEEL
set -euo pipefail

test_packages=(duckdb==2.0.1 "fsspec[http]==2026.9.0" ipykernel==7.4.0 matplotlib==3.11.2
  mypy==2.4.1 nbclient==0.11.0 nbformat==5.11.1 opencv-python-headless==5.0.0.93 pandas==3.1.1
  pillow==13.0.0 playwright==1.65.2 plotly==7.1.0 pyarrow==26.0.1 pytest==9.2.0 pytest-xdist==3.8.0
  pyyaml==6.0.4 ray==2.60.0 rerun-sdk==0.41.0 rosbags==0.11.9)
# What Python 3.11 itself needs, and libstdc++.
root_packages=(libc6 libgcc-s1 libstdc++6 zlib1g libexpat1 libpython3.11-minimal
  libpython3.11-stdlib python3.11-minimal)

# Runs Python in the bare root, as an ordinary user by the means of user namespaces.
python_in_root() {
  local namespaces=()
  [ "$(id -u)" -eq 0 ] || namespaces=(--map-root-user)
  env -i PYTHONPATH=/packages unshare "${namespaces[@]}" --root=root /usr/bin/python3.11 "$@"
}

make_bare_root() {
  mkdir packages root
  (cd packages && apt-get -q -o APT::Sandbox::User=root download "${root_packages[@]}")
  for package in packages/*.deb; do dpkg-deb --extract "$package" root; done
  venv/bin/pip install --quiet --disable-pip-version-check --target root/packages "$wheel"
}

wheel=$(realpath "$1")
tests=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../python/tests")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
/usr/bin/python3 -m venv venv

echo "Import where there are glibc, libstdc++ and Python alone"
make_bare_root
python_in_root -c 'import corvo; print("imported from", corvo.__file__)'

echo "Tests in a new environment"
venv/bin/pip install --quiet --disable-pip-version-check "$wheel" "${test_packages[@]}"
# Two files of tests at a time; those of a file share what it has made.
venv/bin/python -m pytest -q --numprocesses 2 --dist loadfile "$tests"
