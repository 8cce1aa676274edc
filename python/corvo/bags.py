# SPDX-License-Identifier: MIT
"""Images in ROS bags (ROS 1, ROS 2 in SQLite or MCAP), by the package rosbags of corvo[bags].

`corvo run film.mcap` reads bags by this module; `Bag` gives the images to one's own loop.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from corvo._corvo import Error, message_to_gray

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
    from rosbags.highlevel import AnyReader

_IMAGE = "sensor_msgs/msg/Image"
_COMPRESSED_IMAGE = "sensor_msgs/msg/CompressedImage"
_CAMERA_INFO = "sensor_msgs/msg/CameraInfo"


@dataclass(frozen=True)
class ImageMessage:
    """An image as it is in a bag."""

    time_ns: int
    """The stamp of the header, or the time of the recording if the stamp is 0; ns."""
    data: NDArray[np.uint8]
    """The bytes of the pixels, or of an image file if `encoding` is empty."""
    encoding: str = ""
    """As in sensor_msgs/Image."""
    width: int = 0
    height: int = 0
    step: int = 0
    """Bytes from one row to the next."""
    is_big_endian: bool = False


class Bag:
    """The images of one topic of a ROS bag.

    Iteration returns pairs of an image and its time in ns, the stamp of the message's header. The
    image is a gray array of shape (height, width), converted as `corvo run` does, uint8 or, if
    that is what the bag holds, uint16; None if the message is damaged.

    Args:
        path: A .bag, .mcap or .db3 file, or the folder of a ROS 2 bag.
        topic: The topic of the images. It may be left out if the bag has only one.

    Raises:
        Error: The bag cannot be read, has no such topic, or several if none is given.
    """

    def __init__(self, path: str | Path, topic: str = "") -> None:
        self._path = Path(path)
        self._reader = _open(self._path)
        self.topics: dict[str, int] = _image_topics(self._reader)
        """The number of images of each topic of images."""
        self.topic = self._choose(topic)
        """The name of the topic."""

    def __len__(self) -> int:
        return self.topics[self.topic]

    def __iter__(self) -> Iterator[tuple[NDArray[np.uint8 | np.uint16] | None, int]]:
        for index, message in enumerate(self.messages()):
            try:
                yield message_to_gray(message, f"{self._path}, image {index}"), message.time_ns
            except Error:
                yield None, message.time_ns

    @property
    def calibration(self) -> str:
        """The first camera_info beside the topic, as the text of a file that `Camera.load` reads.

        It is empty if there is none, or if its camera is not calibrated (the focal length is 0).
        The camera of a topic image_rect... is that of the rectified images.
        """
        name = _camera_info_topic(self.topic)
        for info in self._read(name, _CAMERA_INFO):
            return _calibration_text(info[0], "image_rect" in self.topic, f"{self._path}: {name}")
        return ""

    def messages(self) -> Iterator[ImageMessage]:
        """Reads the messages in the order of their recording, without converting their images."""
        for message, recorded_ns in self._read(self.topic, _IMAGE, _COMPRESSED_IMAGE):
            stamp = message.header.stamp
            time_ns = stamp.sec * 1_000_000_000 + stamp.nanosec or recorded_ns
            if not hasattr(message, "encoding"):
                yield ImageMessage(time_ns, message.data)
                continue
            yield ImageMessage(
                time_ns,
                message.data,
                # An image file is told from pixels by its empty encoding.
                message.encoding or "(empty)",
                message.width,
                message.height,
                message.step,
                bool(message.is_bigendian),
            )

    def _choose(self, topic: str) -> str:
        names = ", ".join(self.topics) or "none"
        if topic and topic not in self.topics:
            raise Error(f"{self._path}: has no images in topic {topic}; topics of images: {names}")
        if not topic and len(self.topics) != 1:
            raise Error(
                f"{self._path}: has {len(self.topics)} topics of images; name one of them by "
                f"--topic: {names}"
            )
        return topic or next(iter(self.topics))

    def _read(self, topic: str, *types: str) -> Iterator[tuple[Any, int]]:
        """Reads the messages of a topic with the times of their recording, ns."""
        connections = [
            connection
            for connection in self._reader.connections
            if connection.topic == topic and connection.msgtype in types
        ]
        if not connections:
            return
        with _errors_of(self._path):
            for connection, recorded_ns, data in self._reader.messages(connections):
                yield self._reader.deserialize(data, connection.msgtype), recorded_ns


def missing_rosbags(path: Path) -> Error:
    """Returns the error of a bag that is to be read or written without the package rosbags."""
    return Error(f"{path}: ROS bags need the package rosbags: pip install corvo[bags]")


@contextmanager
def _errors_of(path: Path) -> Iterator[None]:
    """Turns whatever rosbags raises for a damaged bag into an Error that names the bag."""
    try:
        yield
    except Exception as error:
        raise Error(f"{path}: is damaged or no ROS bag ({error})") from error


def _open(path: Path) -> AnyReader:
    try:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        raise missing_rosbags(path) from None
    with _errors_of(path):
        reader = AnyReader([path], default_typestore=get_typestore(Stores.LATEST))
        reader.open()
        return reader


def _image_topics(reader: AnyReader) -> dict[str, int]:
    topics: dict[str, int] = {}
    for connection in reader.connections:
        is_depth = connection.topic.endswith("/compressedDepth")
        if connection.msgtype in (_IMAGE, _COMPRESSED_IMAGE) and not is_depth:
            topics[connection.topic] = topics.get(connection.topic, 0) + connection.msgcount
    return topics


def _camera_info_topic(topic: str) -> str:
    """Returns where the drivers of ROS publish the calibration of a topic of images."""
    camera, _, _ = topic.removesuffix("/compressed").rpartition("/")
    return f"{camera}/camera_info"


def _calibration_text(info: Any, is_rectified: bool, where: str) -> str:
    """Returns a CameraInfo message in the form of ROS's camera_info files."""
    # ROS 1 names its arrays in upper case.
    matrix, distortion, projection = (
        getattr(info, name if hasattr(info, name) else name.lower()) for name in "KDP"
    )
    roi = info.roi
    if max(info.binning_x, info.binning_y) > 1 or roi.x_offset or roi.y_offset:
        raise Error(f"{where}: is of binned images or a part of them; give --camera FILE")
    if matrix[0] == 0:
        return ""
    if is_rectified:
        matrix, distortion = projection.reshape(3, 4)[:, :3].ravel(), distortion[:0]
    return json.dumps(
        {
            "image_width": info.width,
            "image_height": info.height,
            "camera_matrix": {"rows": 3, "cols": 3, "data": matrix.tolist()},
            "distortion_model": info.distortion_model or "plumb_bob",
            "distortion_coefficients": {
                "rows": 1,
                "cols": len(distortion),
                "data": distortion.tolist(),
            },
        }
    )
