# SPDX-License-Identifier: MIT
"""A live view of the odometry in Rerun: `pip install corvo[view]`."""

from corvo.view.live import LiveView
from corvo.view.recorder import Intrinsics, Recorder
from corvo.view.result import record_result
from corvo.view.sink import Sink
from corvo.view.viewer import make_stream, save_to, show

__all__ = [
    "Intrinsics",
    "LiveView",
    "Recorder",
    "Sink",
    "make_stream",
    "record_result",
    "save_to",
    "show",
]
