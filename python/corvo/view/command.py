# SPDX-License-Identifier: MIT
"""The command `corvo view`."""

import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import rerun as rr
from numpy.typing import NDArray

import corvo
from corvo import _corvo
from corvo._corvo import Inputs
from corvo.command_parser import CommandParser
from corvo.commands import report
from corvo.similarity import Similarity
from corvo.view.live import LiveView
from corvo.view.recorder import Intrinsics, Recorder
from corvo.view.result import record_result
from corvo.view.sink import Sink
from corvo.view.viewer import make_stream, save_to, show

_DESCRIPTION = """\
Show a finished run, or an odometry while it works, in Rerun: images with their tracks, the path,
landmarks, uncertainties, the state, and the estimated camera."""

_EPILOG = """\
An INPUT takes the options of 'corvo run' that say what is read and how: --camera, --focal, --fov,
--fps, --times, --bits, --start, --every, --count, --resize, --mask, --strict, --gt, --config,
--threads.

Examples:
  corvo view result/03                                # a finished run
  corvo view drive.mp4 --focal auto                   # an odometry while it works
  corvo view dataset/sequences/03 --save drive.rrd    # a recording, for 'rerun drive.rrd'"""


def main(arguments: list[str]) -> int:
    """Executes the command and returns its exit code."""
    _corvo._set_up_logging()
    try:
        known, options = _make_parser().parse_known_args(arguments)
        _view(known.input, known.save, options)
    except corvo.Error as error:
        return report(error)
    return 0


def _make_parser() -> CommandParser:
    parser = CommandParser(
        prog="corvo view",
        usage="corvo view RESULT|INPUT [--save FILE] [OPTIONS]",
        description=_DESCRIPTION,
        epilog=_EPILOG,
    )
    parser.add_argument(
        "input", metavar="RESULT|INPUT", help="the folder of a result, or what 'corvo run' reads"
    )
    parser.add_argument(
        "--save", type=Path, metavar="FILE", help="write a recording (.rrd), and open no viewer"
    )
    return parser


def _view(given: str, file: Path | None, options: list[str]) -> None:
    is_result = (Path(given) / "frames.csv").is_file()
    if is_result and options:
        raise corvo.Error(f"{options[0]}: a result takes no option but --save")
    source = corvo.Result(given) if is_result else Inputs([given, *options])
    stream = make_stream()
    if file is None:
        show(stream)
    else:
        save_to(stream, file)
    if isinstance(source, corvo.Result):
        record_result(source, Recorder(stream, Intrinsics.of(source.camera)))
    else:
        _run(source, stream)
    stream.disconnect()


def _run(inputs: Inputs, stream: rr.RecordingStream) -> None:
    """Runs the odometry and shows it. Ctrl-C ends the sequence."""
    odometry = inputs.odometry()
    recorder = Recorder(stream, Intrinsics.of(inputs.camera))
    with Sink(recorder) as sink:
        live = LiveView(odometry, sink)
        try:
            _process_images(inputs, odometry, live)
        except KeyboardInterrupt:
            print("corvo: interrupted; what was found is shown", file=sys.stderr)
        trajectory = live.finish()
        if len(inputs.true_positions) > 0 and trajectory.posed_share > 0:
            sink.truth(_align_truth(inputs, trajectory))
    if sink.num_dropped > 0:
        total = len(trajectory)
        print(f"corvo: {sink.num_dropped} of {total} images were not shown", file=sys.stderr)


def _align_truth(inputs: Inputs, trajectory: corvo.Trajectory) -> NDArray[np.float64]:
    """Returns the true path in the world of the trajectory, shape (n, 3)."""
    with TemporaryDirectory(prefix="corvo_") as folder:
        truth = Path(folder) / "groundtruth.tum"
        inputs.write_truth(truth)
        evaluation = corvo.evaluate(trajectory, truth)
    return Similarity(evaluation["truth_from_estimate"]).apply_inverse(inputs.true_positions)


def _process_images(inputs: Inputs, odometry: corvo.Odometry, live: LiveView) -> None:
    for timestamp_ns, image, mask in inputs:
        start = time.perf_counter()
        if image is None:
            frame = odometry.process_missing(timestamp_ns)
        else:
            frame = odometry.process(image, timestamp_ns, mask)
        live.add(frame, image, 1e3 * (time.perf_counter() - start))
