# SPDX-License-Identifier: MIT
"""Shows an odometry while it works."""

import numpy as np
from numpy.typing import NDArray

import corvo
from corvo.view.frame import Frame
from corvo.view.sink import Sink


class LiveView:
    """Passes to a sink what an odometry finds.

    Args:
        odometry: The odometry whose frames are shown.
        sink: Where they are shown.
    """

    def __init__(self, odometry: corvo.Odometry, sink: Sink) -> None:
        self._odometry = odometry
        self._sink = sink
        self._next_landmark = 0

    def add(
        self,
        frame: Frame,
        image: NDArray[np.uint8] | None = None,
        latency_ms: float | None = None,
    ) -> None:
        """Shows the frame that the odometry has just processed.

        Args:
            frame: What Odometry.process() returned.
            image: Its image, which is copied; or None.
            latency_ms: The time for which the odometry worked on it, or None.
        """
        mask = None if image is None else self._odometry.used_mask
        self._sink.frame(frame, image, mask, latency_ms)
        if frame.is_keyframe:
            self._add_landmarks()
            self._add_camera()

    def finish(self) -> corvo.Trajectory:
        """Finishes the odometry, shows the final path and returns the trajectory."""
        trajectory = self._odometry.finish()
        paths: dict[int, list[NDArray[np.float64]]] = {}
        for frame in trajectory.frames:
            if frame.world_from_camera is not None and frame.segment is not None:
                paths.setdefault(frame.segment, []).append(frame.world_from_camera[:3, 3])
        self._sink.finish({segment: np.array(path) for segment, path in paths.items()})
        return trajectory

    def _add_landmarks(self) -> None:
        created = self._odometry.landmarks_from(self._next_landmark)
        if len(created.ids) > 0:
            self._next_landmark = int(created.ids.max()) + 1
            self._sink.landmarks(created.positions)

    def _add_camera(self) -> None:
        camera = self._odometry.camera
        parameters = camera.parameters
        for name, sigma in (camera.sigma or {}).items():
            if name == "focal":  # A factor of both focal lengths.
                name, sigma = "fx", sigma * parameters["fx"]
            self._sink.camera(name, parameters[name], sigma)
