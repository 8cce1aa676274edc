#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares a model by corvo with COLMAP's automatic reconstruction of the same images, without a
calibration: processor time, registered images, points, mean reprojection error and, where there is
ground truth in TUM format with the timestamps of corvo's frames, the position error after Sim3.

COLMAP gets every posed image, as from a film; one camera (OPENCV), SIFT on the processor and
sequential matching with 10 neighbors, as its automatic reconstruction of videos does. Needs pycolmap
(scripts/install_dependencies.sh --development).

usage: .venv/bin/python scripts/compare_with_colmap.py INPUT [--truth FILE] [OPTIONS OF corvo run]
"""
import argparse
import json
import pathlib
import resource
import subprocess
import tempfile

import numpy as np
import pycolmap

CORVO = pathlib.Path(__file__).resolve().parent.parent / "build/release/apps/corvo"


def processor_s(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def position_error(model, truth):
    """Returns the root mean square of the position errors after Sim3 (Umeyama 1991)."""
    pairs = [(im.projection_center(), truth[im.name]) for im in model.images.values()
             if im.name in truth]
    if len(pairs) < 3:
        return None
    a, b = (np.array(p) for p in zip(*pairs))
    a0, b0 = a - a.mean(0), b - b.mean(0)
    u, s, vt = np.linalg.svd(b0.T @ a0)
    d = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    scale = np.trace(np.diag(s) @ d) / (a0 ** 2).sum()
    return float(np.sqrt(((scale * a0 @ (u @ d @ vt).T - b0) ** 2).sum(1).mean()))


def truth_by_name(result, file):
    """Returns the true position of each image of a run."""
    rows = [line.split() for line in open(file) if line.strip() and not line.startswith("#")]
    times = np.array([float(r[0]) for r in rows])
    positions = np.array([[float(x) for x in r[1:4]] for r in rows])
    by_name = {}
    header, *frames = (result / "frames.csv").read_text().splitlines()
    columns = header.split(",")
    for line in frames:
        row = dict(zip(columns, line.split(",")))
        nearest = np.argmin(abs(times - float(row["timestamp"])))
        if abs(times[nearest] - float(row["timestamp"])) < 0.02:
            by_name[row["image"]] = positions[nearest]
    return by_name


def report(name, model, seconds, truth):
    error = position_error(model, truth)
    print(f"{name:8} {seconds:8.1f} s of processor, {model.num_reg_images():4} images, "
          f"{model.num_points3D():6} points, {model.compute_mean_reprojection_error():.2f} px"
          + (f", position error {error:.4f}" if error is not None else ""))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("input")
    parser.add_argument("--truth")
    arguments, run_options = parser.parse_known_args()
    work = pathlib.Path(tempfile.mkdtemp())
    result, model = work / "result", work / "model"
    before = processor_s(resource.RUSAGE_CHILDREN)
    subprocess.run([CORVO, "run", arguments.input, "--focal", "auto", "-o", result, "--quiet",
                    *run_options], check=True)
    subprocess.run([CORVO, "export", result, "--to", "colmap", "--images", "-o", model],
                   check=True, stdout=subprocess.DEVNULL)
    corvo_s = processor_s(resource.RUSAGE_CHILDREN) - before
    truth = truth_by_name(result, arguments.truth) if arguments.truth else {}
    report("corvo", pycolmap.Reconstruction(model / "sparse/0"), corvo_s, truth)

    images = work / "all/images"
    subprocess.run([CORVO, "export", result, "--to", "colmap", "--images", "--frames", "all",
                    "-o", images.parent], check=True, stdout=subprocess.DEVNULL)
    pycolmap.logging.minloglevel = 2
    before = processor_s(resource.RUSAGE_SELF)
    database = work / "database.db"
    reader = pycolmap.ImageReaderOptions()
    reader.camera_model = "OPENCV"
    pycolmap.extract_features(database, images, reader_options=reader,
                              camera_mode=pycolmap.CameraMode.SINGLE,
                              device=pycolmap.Device.cpu)
    pycolmap.match_sequential(database, device=pycolmap.Device.cpu)
    (work / "sparse").mkdir()
    models = pycolmap.incremental_mapping(database, images, work / "sparse")
    colmap_s = processor_s(resource.RUSAGE_SELF) - before
    best = max(models.values(), key=lambda m: m.num_reg_images())
    report("COLMAP", best, colmap_s, truth)
    print(json.dumps({"ratio": colmap_s / corvo_s}))


if __name__ == "__main__":
    main()
