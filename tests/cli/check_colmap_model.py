# SPDX-License-Identifier: MIT
"""Reads a COLMAP model with pycolmap and prints, as JSON, its counts, its reprojection errors, how
far the errors stated in the model are from them, and what pycolmap's bundle adjustment makes of the
model: the share of the cost that remains, of squared errors and with Huber's loss from 1 px on, and
for squared errors the largest movement of a camera relative to the path.

usage: check_colmap_model.py MODEL
"""
import json
import sys

import numpy as np
import pycolmap

model, robust = (pycolmap.Reconstruction(sys.argv[1]) for _ in range(2))
errors, points = [], {}
for image in model.images.values():
    for observation in image.points2D:
        if not observation.has_point3D():
            continue
        xyz = model.points3D[observation.point3D_id].xyz
        error = float(np.linalg.norm(image.project_point(xyz) - observation.xy))
        errors.append(error)
        points.setdefault(observation.point3D_id, []).append(error)
stated = max(abs(np.mean(e) - model.points3D[i].error) for i, e in points.items())


def centers():
    return np.array([model.images[i].projection_center() for i in sorted(model.images)])


def squared_errors(model):
    return np.array([np.sum((im.project_point(model.points3D[o.point3D_id].xyz) - o.xy) ** 2)
                     for im in model.images.values() for o in im.points2D if o.has_point3D()])


def huber_loss(squared):
    return np.where(squared <= 1, squared, 2 * np.sqrt(squared) - 1)


def adjust(model, loss_type, loss):
    """Adjusts a model with its camera held fixed. Returns the share of the cost that remains."""
    options = pycolmap.BundleAdjustmentOptions()
    options.refine_focal_length = options.refine_principal_point = False
    options.refine_extra_params = options.print_summary = False
    options.ceres.loss_function_type = loss_type
    before = loss(squared_errors(model)).sum()
    pycolmap.bundle_adjustment(model, options)
    return float(loss(squared_errors(model)).sum() / before)


before = centers()
cost_ratio = adjust(model, pycolmap.LossFunctionType.TRIVIAL, lambda squared: squared)
robust_cost_ratio = adjust(robust, pycolmap.LossFunctionType.HUBER, huber_loss)
after = centers()
path = np.linalg.norm(np.diff(before, axis=0), axis=1).sum()
a, b = after - after.mean(0), before - before.mean(0)
u, s, vt = np.linalg.svd(b.T @ a)
d = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
scale = np.trace(np.diag(s) @ d) / (a ** 2).sum()
moved = np.linalg.norm(scale * a @ (u @ d @ vt).T - b, axis=1).max() / path
print(json.dumps({"images": len(model.images), "points": len(model.points3D),
                  "observations": len(errors), "mean_error": float(np.mean(errors)),
                  "stated": float(stated), "cost_ratio": cost_ratio,
                  "robust_cost_ratio": robust_cost_ratio, "moved": float(moved)}))
