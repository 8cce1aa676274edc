# SPDX-License-Identifier: MIT
"""Monocular visual odometry: images in, camera trajectory and sparse map out.

run() does what the command `corvo run` does; Odometry takes images one at a time; orb, two_view(),
refine(), calibrate(), evaluate() and export() are single stages.
"""

from pathlib import Path

from corvo import _corvo, orb
from corvo._corvo import (
    Camera,
    Error,
    FrameResult,
    MapPoints,
    Odometry,
    Options,
    PoseGraph,
    PoseGraphEdge,
    PoseGraphVertex,
    ProcessedFrame,
    Refinement,
    RelativePose,
    Trajectory,
    TwoViewMotion,
    read_tum,
    refine,
    shipped_cameras,
    two_view,
)
from corvo.calibration import calibrate
from corvo.evaluation import evaluate
from corvo.result import Result
from corvo.runs import export, run

__all__ = [
    "Camera",
    "Error",
    "FrameResult",
    "MapPoints",
    "Odometry",
    "Options",
    "PoseGraph",
    "PoseGraphEdge",
    "PoseGraphVertex",
    "ProcessedFrame",
    "Refinement",
    "RelativePose",
    "Result",
    "Trajectory",
    "TwoViewMotion",
    "calibrate",
    "evaluate",
    "export",
    "orb",
    "read_tum",
    "refine",
    "run",
    "shipped_cameras",
    "two_view",
]

_corvo._set_config_folder(Path(__file__).parent / "configs")
