# SPDX-License-Identifier: MIT
"""The ages of tracks."""

import numpy as np
from numpy.typing import NDArray


class TrackAges:
    """Counts the frames in which each landmark was observed."""

    MAX_GAP = 10
    """A track ends if its landmark is not observed for more than this many frames."""

    def __init__(self) -> None:
        self._tracks: dict[int, tuple[int, int]] = {}  # Age and last frame of each landmark.

    def add(self, frame: int, landmarks: NDArray[np.int64]) -> NDArray[np.int64]:
        """Adds the landmarks, of shape (n,), that a frame observes. Returns their ages, (n,)."""
        ages = [self._tracks.get(landmark, (0, 0))[0] + 1 for landmark in landmarks.tolist()]
        self._tracks.update(
            (landmark, (age, frame)) for landmark, age in zip(landmarks.tolist(), ages)
        )
        self._tracks = {
            landmark: track
            for landmark, track in self._tracks.items()
            if frame - track[1] <= self.MAX_GAP
        }
        return np.array(ages, np.int64)
