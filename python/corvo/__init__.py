# SPDX-License-Identifier: MIT
"""Monocular visual odometry: images in, camera trajectory and sparse map out."""

from corvo._corvo import (
    Camera,
    Error,
    FrameResult,
    Odometry,
    Options,
    ProcessedFrame,
    RelativePose,
    Trajectory,
    shipped_cameras,
)

__all__ = [
    "Camera",
    "Error",
    "FrameResult",
    "Odometry",
    "Options",
    "ProcessedFrame",
    "RelativePose",
    "Trajectory",
    "shipped_cameras",
]
