#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the nerfstudio export of a result by nerfstudio's own data parser, which ns-train uses:
every pixel's ray must be that of the COLMAP export read by pycolmap, and so must the points, up to
the one rotation between the worlds of both formats.

Needs nerfstudio, with PyTorch, and pycolmap in one environment; they are too large for the project's
own (scripts/install_dependencies.sh):

  python3 -m venv nerfstudio && nerfstudio/bin/pip install nerfstudio pycolmap
  nerfstudio/bin/python scripts/check_nerfstudio.py RESULT
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import pycolmap
import torch
from nerfstudio.data.dataparsers.nerfstudio_dataparser import NerfstudioDataParserConfig

CORVO = pathlib.Path(__file__).resolve().parent.parent / "build/release/apps/corvo"
PIXELS = 200  # Of each image, at random.


def export(result, model, form):
    subprocess.run([CORVO, "export", result, "--to", form, "--images", "-o", model], check=True,
                   stdout=subprocess.DEVNULL)


def parse(model):
    """Returns what ns-train gets, in the world of the file."""
    parser = NerfstudioDataParserConfig(
        data=model, orientation_method="none", center_method="none", auto_scale_poses=False,
        eval_mode="all", downscale_factor=1, load_3D_points=True)
    return parser.setup().get_dataparser_outputs("train")


def rays_of_nerfstudio(cameras, index, pixels):
    """Returns the camera's position and the direction of each pixel (x, y) in the world."""
    coordinates = torch.tensor(pixels[:, ::-1].copy(), dtype=torch.float32)
    rays = cameras.generate_rays(index, coords=coordinates)
    return rays.origins[0].numpy(), rays.directions.numpy()


def rays_of_colmap(image, pixels):
    in_camera = np.array([np.append(image.camera.cam_from_img(p), 1) for p in pixels])
    rotation = image.cam_from_world().rotation.matrix()
    directions = in_camera @ rotation
    return (image.projection_center(),
            directions / np.linalg.norm(directions, axis=1, keepdims=True))


def main():
    work = pathlib.Path(tempfile.mkdtemp())
    for form in ("colmap", "nerfstudio"):
        export(sys.argv[1], work / form, form)
    colmap = pycolmap.Reconstruction(work / "colmap/sparse/0")
    by_name = {pathlib.Path(image.name).name: image for image in colmap.images.values()}
    parsed = parse(work / "nerfstudio")
    random = np.random.default_rng(1)
    camera = next(iter(colmap.cameras.values()))
    pixels = random.uniform(0, 1, (PIXELS, 2)) * [camera.width, camera.height]
    ours, theirs = [], []
    for index, file in enumerate(parsed.image_filenames):
        ours.append(rays_of_colmap(by_name[file.name], pixels))
        theirs.append(rays_of_nerfstudio(parsed.cameras, index, pixels))
    # The rotation between the worlds, from the first image.
    u, _, vt = np.linalg.svd(theirs[0][1].T @ ours[0][1])
    rotation = u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt
    focal = camera.mean_focal_length()
    ray_px = max(np.linalg.norm(t[1] - o[1] @ rotation.T, axis=1).max() * focal
                 for o, t in zip(ours, theirs))
    centers = np.array([o[0] for o in ours])
    size = np.linalg.norm(centers.max(0) - centers.min(0))
    moved = max(np.linalg.norm(t[0] - rotation @ o[0]) for o, t in zip(ours, theirs)) / size
    points = np.array([p.xyz for _, p in sorted(colmap.points3D.items())]) @ rotation.T
    read = parsed.metadata["points3D_xyz"].numpy()
    nearest = max(np.linalg.norm(read - p, axis=1).min() / np.linalg.norm(p) for p in points)
    up = np.mean([rotation @ -image.cam_from_world().rotation.matrix()[1]
                  for image in by_name.values()], axis=0)
    print(f"{len(ours)} images, {len(read)} points: rays agree within {ray_px:.1e} px, positions "
          f"within {moved:.1e} of the path's extent, points within {nearest:.1e} of their distance; "
          f"up is {np.round(up, 2)}")
    if not (ray_px < 0.01 and moved < 1e-5 and nearest < 1e-5 and len(read) == len(points)):
        raise SystemExit("the exports disagree")


if __name__ == "__main__":
    main()
