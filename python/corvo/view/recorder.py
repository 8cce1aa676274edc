# SPDX-License-Identifier: MIT
"""Logs a run to a recording of Rerun."""

from dataclasses import dataclass

import numpy as np
import rerun as rr
from numpy.typing import NDArray

import corvo
from corvo.view import colors, images
from corvo.view.ellipsoid import make_ellipsoid
from corvo.view.frame import Frame
from corvo.view.path import PathPieces, Piece
from corvo.view.tracks import TrackAges

_THIN = rr.Radius.ui_points(1.0)
_THICK = rr.Radius.ui_points(2.0)
_FRUSTUM_SHARE = 0.15
"""Length of the frustum as a share of the median distance of the first landmarks."""


@dataclass(frozen=True)
class Intrinsics:
    """What the frustum needs of a camera, in px; integers are pixel centers."""

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float

    @classmethod
    def of(cls, camera: corvo.Camera) -> "Intrinsics":
        values = camera.parameters
        width, height = int(values["width"]), int(values["height"])
        return cls(width, height, values["fx"], values["fy"], values["cx"], values["cy"])


class Recorder:
    """Logs frames, landmarks, the camera and the ground truth to a recording.

    The work for a frame and the size of what is logged for it are bounded: the path is logged in
    pieces, of which only the current one is logged anew, and a landmark is logged once. The
    timelines are "frame" (index of the frame) and "time" (its timestamp). One thread at a time may
    use a recorder.

    Args:
        stream: The recording.
        camera: The camera of the images.
    """

    def __init__(self, stream: rr.RecordingStream, camera: Intrinsics) -> None:
        self._stream = stream
        self._camera = camera
        self._reduction = images.reduction(camera.width, camera.height)
        self._ages = TrackAges()
        self._path = PathPieces()
        self._position = np.zeros(3)
        self._has_frustum = False
        self._states: dict[str, str] = {}
        self._log_styles()

    def frame(
        self,
        frame: Frame,
        image: NDArray[np.uint8] | None = None,
        mask: NDArray[np.uint8] | None = None,
        latency_ms: float | None = None,
    ) -> None:
        """Logs a frame.

        Args:
            frame: Its outcome, pose and tracks.
            image: Shape (height, width), gray, or (height, width, 3), RGB; or None.
            mask: Shape (height, width), 0 where no features are detected; or None.
            latency_ms: The time for which the odometry worked on the frame, or None.
        """
        self._stream.set_time("frame", sequence=frame.index)
        self._stream.set_time("time", timestamp=np.datetime64(frame.timestamp_ns, "ns"))
        self._log_image(image, mask)
        self._log_tracks(frame)
        self._log_pose(frame)
        self._log_path(frame)
        self._log_series(frame, latency_ms)
        self._log_state("state", frame.state)
        self._log_state("reason", frame.reason)

    def landmarks(
        self, positions: NDArray[np.float64], rgb: NDArray[np.uint8] | None = None
    ) -> None:
        """Logs new landmarks at the frame that was logged last.

        Args:
            positions: In the world, shape (n, 3).
            rgb: Their colors, shape (n, 3), or None.
        """
        if len(positions) == 0:
            return
        self._stream.log(
            "world/landmarks",
            rr.Points3D(positions, colors=colors.LANDMARKS if rgb is None else rgb, radii=_THIN),
        )
        self._log_frustum(positions)

    def camera(self, name: str, value: float, sigma: float) -> None:
        """Logs an estimated parameter of the camera, with the band of two standard deviations."""
        values = [value, value - 2 * sigma, value + 2 * sigma]
        self._stream.log(f"camera/{name}", rr.Scalars(values))

    def truth(self, positions: NDArray[np.float64]) -> None:
        """Logs the true path, aligned with the world of the trajectory, for all times; (n, 3)."""
        strip = rr.LineStrips3D([positions], colors=[colors.TRUTH], radii=_THIN)
        self._stream.log("world/truth", strip, static=True)

    def finish(self, paths: dict[int, NDArray[np.float64]] | None = None) -> None:
        """Completes the recording.

        Args:
            paths: The final path of each segment, shape (n, 3), where later adjustments have
                changed it; it is shown beside the path as it was found.

        Raises:
            Error: The viewer was closed, or the file cannot be written.
        """
        self._log_piece(self._path.finish())
        self._stream.log("world/current", rr.Clear(recursive=False))
        for segment, positions in (paths or {}).items():
            self._log_strip(f"world/final/{segment}", positions, colors.segment_color(segment))
        try:
            self._stream.flush()
        except RuntimeError as error:
            raise corvo.Error(f"the recording is not complete: {error}") from error

    def _log_styles(self) -> None:
        log = self._stream.log
        log("world", rr.ViewCoordinates.RDF, static=True)
        log("series/matches", rr.SeriesLines(names=["inliers", "matches"]), static=True)
        log("series/parallax", rr.SeriesLines(names=["parallax [deg]"]), static=True)
        log("series/latency", rr.SeriesLines(names=["latency [ms]"]), static=True)
        states = rr.StateConfiguration(values=list(colors.STATES), colors=list(colors.STATES.values()))
        log("state", states, static=True)

    def _log_image(self, image: NDArray[np.uint8] | None, mask: NDArray[np.uint8] | None) -> None:
        if image is not None:
            self._stream.log("world/camera/image", images.encode(image, mask, self._reduction))

    def _log_tracks(self, frame: Frame) -> None:
        ages = self._ages.add(frame.index, frame.landmarks)
        self._stream.log(
            "world/camera/image/tracks",
            rr.Points2D(
                (frame.keypoints + 0.5) / self._reduction,
                colors=colors.age_colors(ages),
                radii=_THICK,
            ),
        )

    def _log_pose(self, frame: Frame) -> None:
        pose = frame.world_from_camera
        if pose is None:
            return
        self._position = pose[:3, 3]
        self._stream.log(
            "world/camera", rr.Transform3D(translation=pose[:3, 3], mat3x3=pose[:3, :3])
        )
        if frame.relative_pose is None:
            return
        ellipsoid = make_ellipsoid(pose, frame.relative_pose.covariance)
        self._stream.log("world/newest_uncertainty", ellipsoid)
        if frame.is_keyframe:
            self._stream.log("world/uncertainty", ellipsoid)

    def _log_path(self, frame: Frame) -> None:
        pose = frame.world_from_camera
        position = None if pose is None else pose[:3, 3]
        self._log_piece(self._path.add(position, frame.segment, frame.is_keyframe))
        current = self._path.current
        if current is not None:
            color = colors.segment_color(current.segment)
            self._log_strip("world/current", np.array(current.positions), color)

    def _log_piece(self, piece: Piece | None) -> None:
        if piece is not None:
            color = colors.segment_color(piece.segment)
            self._log_strip("world/path", np.array(piece.positions), color)

    def _log_strip(
        self, entity: str, positions: NDArray[np.float64], color: tuple[int, int, int]
    ) -> None:
        self._stream.log(entity, rr.LineStrips3D([positions], colors=[color], radii=_THICK))

    def _log_series(self, frame: Frame, latency_ms: float | None) -> None:
        log = self._stream.log
        log("series/matches", rr.Scalars([frame.num_inliers, frame.num_matches]))
        log("series/parallax", rr.Scalars(frame.parallax_deg))
        if latency_ms is not None:
            log("series/latency", rr.Scalars(latency_ms))

    def _log_state(self, entity: str, state: str) -> None:
        if self._states.get(entity) != state:
            self._stream.log(entity, rr.StateChange(state=state))
            self._states[entity] = state

    def _log_frustum(self, landmarks: NDArray[np.float64]) -> None:
        if self._has_frustum:
            return
        self._has_frustum = True
        distance = float(np.median(np.linalg.norm(landmarks - self._position, axis=1)))
        camera, factor = self._camera, self._reduction
        self._stream.log(
            "world/camera/image",
            rr.Pinhole(
                resolution=np.array([camera.width, camera.height]) / factor,
                focal_length=np.array([camera.fx, camera.fy]) / factor,
                principal_point=(np.array([camera.cx, camera.cy]) + 0.5) / factor,
                image_plane_distance=_FRUSTUM_SHARE * distance,
                camera_xyz=rr.ViewCoordinates.RDF,
            ),
            static=True,
        )
