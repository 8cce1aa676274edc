# SPDX-License-Identifier: MIT
"""Logs a run on a thread of its own."""

import queue
import threading
from collections.abc import Callable
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from corvo.view.frame import Frame
from corvo.view.recorder import Recorder


class Sink:
    """Logs to a recorder on a thread of its own, so that the odometry need not wait for it.

    If more than MAX_IMAGES images wait, further images are dropped and counted; everything else is
    kept. Use it in a `with` statement, whose end waits until everything is logged.

    Args:
        recorder: Used by the sink alone from now on.
    """

    MAX_IMAGES = 8

    def __init__(self, recorder: Recorder) -> None:
        self.num_dropped = 0
        """Number of images that were dropped."""
        self._recorder = recorder
        self._tasks: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._waiting_images = threading.Semaphore(self.MAX_IMAGES)
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._work, name="corvo view", daemon=True)
        self._thread.start()

    def __enter__(self) -> "Sink":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._tasks.put(None)
        self._thread.join()
        if self._error is not None and error is None:
            raise self._error

    def frame(
        self,
        frame: Frame,
        image: NDArray[np.uint8] | None = None,
        mask: NDArray[np.uint8] | None = None,
        latency_ms: float | None = None,
    ) -> None:
        """Logs a frame as Recorder.frame() does. The image is copied."""
        if image is not None and not self._waiting_images.acquire(blocking=False):
            self.num_dropped += 1
            image = None
        copy = None if image is None else image.copy()
        self._tasks.put(lambda: self._log_frame(frame, copy, mask, latency_ms))

    def landmarks(self, positions: NDArray[np.float64]) -> None:
        """Logs landmarks as Recorder.landmarks() does."""
        self._tasks.put(lambda: self._recorder.landmarks(positions))

    def camera(self, name: str, value: float, sigma: float) -> None:
        """Logs a parameter of the camera as Recorder.camera() does."""
        self._tasks.put(lambda: self._recorder.camera(name, value, sigma))

    def truth(self, positions: NDArray[np.float64]) -> None:
        """Logs the true path as Recorder.truth() does."""
        self._tasks.put(lambda: self._recorder.truth(positions))

    def finish(self, paths: dict[int, NDArray[np.float64]]) -> None:
        """Completes the recording as Recorder.finish() does."""
        self._tasks.put(lambda: self._recorder.finish(paths))

    def _log_frame(
        self,
        frame: Frame,
        image: NDArray[np.uint8] | None,
        mask: NDArray[np.uint8] | None,
        latency_ms: float | None,
    ) -> None:
        try:
            self._recorder.frame(frame, image, mask, latency_ms)
        finally:
            if image is not None:
                self._waiting_images.release()

    def _work(self) -> None:
        """Executes the tasks in their order; after an error, none."""
        while (task := self._tasks.get()) is not None:
            if self._error is not None:
                continue
            try:
                task()
            except Exception as error:
                self._error = error
