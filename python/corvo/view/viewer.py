# SPDX-License-Identifier: MIT
"""Where a recording goes: a file, or a viewer that sends no usage data."""

import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import rerun as rr

import corvo
from corvo.view.blueprint import make_blueprint

_LOCALHOST = "127.0.0.1"
_START_S = 60


def make_stream() -> rr.RecordingStream:
    """Returns a recording that goes nowhere yet, with the timelines of the frames alone."""
    stream = rr.RecordingStream("corvo")
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    return stream


def save_to(stream: rr.RecordingStream, file: Path) -> None:
    """Sends a recording to a file (.rrd), which is replaced."""
    stream.save(file, default_blueprint=make_blueprint())


def show(stream: rr.RecordingStream) -> "subprocess.Popen[bytes]":
    """Sends a recording to the window of a new viewer, which only this machine reaches.

    Returns:
        The process of the viewer, which outlives this one.

    Raises:
        Error: There is no display, or the viewer does not start.
    """
    if not any(name in os.environ for name in ("DISPLAY", "WAYLAND_DISPLAY")):
        raise corvo.Error("there is no display for a viewer; write a recording with --save FILE")
    port = _free_port()
    command = ["--bind", _LOCALHOST, "--port", str(port), "--expect-data-soon"]
    viewer = subprocess.Popen(
        [sys.executable, "-m", "rerun", *command],
        env=silent_environment(),
        start_new_session=True,
    )
    _wait_for(viewer, port)
    address = f"rerun+http://{_LOCALHOST}:{port}/proxy"
    stream.connect_grpc(address, default_blueprint=make_blueprint())
    return viewer


def silent_environment() -> dict[str, str]:
    """Returns the environment in which Rerun neither collects nor sends usage data.

    It does neither where CI is set, and leaves the user's configuration of Rerun as it is.
    """
    environment = dict(os.environ, CI="true")
    environment.pop("FORCE_RERUN_ANALYTICS", None)
    return environment


def _wait_for(viewer: "subprocess.Popen[bytes]", port: int) -> None:
    """Waits until a viewer takes connections: what is sent before is lost."""
    deadline = time.monotonic() + _START_S
    while viewer.poll() is None and time.monotonic() < deadline:
        try:
            socket.create_connection((_LOCALHOST, port)).close()
            return
        except ConnectionRefusedError:
            time.sleep(0.05)
    raise corvo.Error("the viewer of Rerun did not start; write a recording with --save FILE")


def _free_port() -> int:
    with socket.socket() as server:
        server.bind((_LOCALHOST, 0))
        port: int = server.getsockname()[1]
        return port
