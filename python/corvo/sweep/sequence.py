# SPDX-License-Identifier: MIT
"""The images of a perturbed sequence."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from tempfile import TemporaryFile
from typing import IO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from corvo._corvo import Inputs, Odometry
from corvo.sweep.degradation import degrade
from corvo.sweep.inputs import run_arguments
from corvo.sweep.perturbation import Perturbation

_Pixels = NDArray[np.uint8] | None


@dataclass(frozen=True)
class Frame:
    """An image with the time at which the odometry gets it.

    `true_time_ns` is that at which it was taken, or None where the sequence repeats itself.
    """

    time_ns: int
    true_time_ns: int | None
    image: _Pixels
    mask: _Pixels


class Sequence:
    """The images of an input under a perturbation.

    Args:
        location: A file or folder.
        options: Options of `corvo run` by their names.
        count: The number of first images of which the perturbation selects some, or None for all.
        perturbation: The perturbation.

    Raises:
        Error: The input cannot be read.
    """

    def __init__(
        self, location: str, options: dict[str, str], count: int | None, perturbation: Perturbation
    ) -> None:
        self._perturbation = perturbation
        start, stride = perturbation.start, perturbation.stride
        selection = {"start": str(start), "every": str(stride)}
        if count is not None:
            selection["count"] = str(max(1, math.ceil((count - start) / stride)))
        self._arguments = run_arguments(location, options | selection)
        self._inputs = Inputs(self._arguments)

    @property
    def truth_file(self) -> str:
        """The file of the ground truth, or an empty text."""
        return self._inputs.truth_file

    def odometry(self) -> Odometry:
        return self._inputs.odometry()

    def frames(self) -> Iterator[Frame]:
        """Yields the frames in the order in which the odometry gets them."""
        offset_ns = 0
        for number in range(self._perturbation.passes):
            times = []
            for frame in self._one_pass():
                times.append(frame.time_ns)
                true_time_ns = frame.true_time_ns if number == 0 else None
                yield replace(frame, time_ns=frame.time_ns + offset_ns, true_time_ns=true_time_ns)
            if len(times) < 2:
                return
            span_ns = times[-1] - times[0]
            offset_ns += span_ns + span_ns // (len(times) - 1)
            self._inputs = Inputs(self._arguments)

    def _one_pass(self) -> Iterator[Frame]:
        frames = self._selected()
        if self._perturbation.reversal:
            frames = _reversed(frames)
        if self._perturbation.repetition:
            frames = _with_repetitions(frames, self._perturbation.repetition)
        return frames

    def _selected(self) -> Iterator[Frame]:
        for i, (time_ns, image, mask) in enumerate(self._inputs):
            index = self._perturbation.start + i * self._perturbation.stride
            if image is not None:
                image = degrade(image, self._perturbation, index)
            yield Frame(time_ns, time_ns, image, mask)


def _with_repetitions(frames: Iterator[Frame], interval: int) -> Iterator[Frame]:
    """Repeats every interval-th frame in the middle between it and the next."""
    repeated = None
    for i, frame in enumerate(frames):
        if repeated is not None:
            middle_ns = (repeated.time_ns + frame.time_ns) // 2
            yield replace(repeated, time_ns=middle_ns, true_time_ns=None)
        repeated = frame if i % interval == interval - 1 else None
        yield frame


def _reversed(frames: Iterator[Frame]) -> Iterator[Frame]:
    """Reverses frames and mirrors their times. The images wait in a temporary file."""
    with TemporaryFile() as file:
        stored = [(f.time_ns, _store(file, f.image), _store(file, f.mask)) for f in frames]
        mirror_ns = stored[0][0] + stored[-1][0] if stored else 0
        for time_ns, image, mask in reversed(stored):
            yield Frame(mirror_ns - time_ns, time_ns, _load(file, image), _load(file, mask))


class _Stored(NamedTuple):
    """Where an array is in a file."""

    offset: int
    shape: tuple[int, ...]


def _store(file: IO[bytes], pixels: _Pixels) -> _Stored | None:
    if pixels is None:
        return None
    offset = file.tell()
    file.write(np.ascontiguousarray(pixels).data)
    return _Stored(offset, pixels.shape)


def _load(file: IO[bytes], stored: _Stored | None) -> _Pixels:
    if stored is None:
        return None
    file.seek(stored.offset)
    return np.frombuffer(file.read(math.prod(stored.shape)), np.uint8).reshape(stored.shape)
