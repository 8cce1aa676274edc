#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds corvo, renders a walk through a synthetic room with exact ground
# truth, runs the odometry on it and prints how accurate it was and where the results are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
cmake --preset release
cmake --build --preset release --target corvo
corvo=build/release/apps/corvo

rm -rf demo/room demo/result
"$corvo" synth room -o demo/room
"$corvo" run demo/room --camera demo/room/camera.yaml --gt demo/room/groundtruth.txt -o demo/result

echo
echo "Accuracy against the exact ground truth:"
"$corvo" eval demo/result/trajectory.tum demo/room/groundtruth.txt
echo
echo "Trajectory: $PWD/demo/result/trajectory.tum"
echo "Picture:    $PWD/demo/result/trajectory.png"
