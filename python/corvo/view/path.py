# SPDX-License-Identifier: MIT
"""The path of the camera in pieces, so that no part of it is logged anew."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass
class Piece:
    """Consecutive positions of the camera in one segment."""

    segment: int
    positions: list[NDArray[np.float64]] = field(default_factory=list)


class PathPieces:
    """Divides the path at the keyframes, and where a frame has no pose or another segment begins.

    A piece has at most MAX_POSITIONS positions, so that logging the current one at every frame
    costs a bounded number of points a frame, also where a camera that stands still has no keyframe.
    """

    MAX_POSITIONS = 32

    def __init__(self) -> None:
        self.current: Piece | None = None

    def add(
        self, position: NDArray[np.float64] | None, segment: int | None, is_keyframe: bool
    ) -> Piece | None:
        """Adds a frame, of which position and segment are None without a pose.

        Returns:
            The piece that is complete with this frame, or None.
        """
        if position is None or segment is None:
            return self._complete(None)
        if self.current is None or self.current.segment != segment:
            return self._complete(Piece(segment, [position]))
        self.current.positions.append(position)
        if is_keyframe or len(self.current.positions) == self.MAX_POSITIONS:
            return self._complete(Piece(segment, [position]))
        return None

    def finish(self) -> Piece | None:
        """Returns the last piece, which is complete as it is."""
        return self._complete(None)

    def _complete(self, following: Piece | None) -> Piece | None:
        completed, self.current = self.current, following
        return completed
