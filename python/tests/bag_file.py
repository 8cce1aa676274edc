# SPDX-License-Identifier: MIT
"""ROS bags for tests, written with the package rosbags."""

from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from rosbags import rosbag1, rosbag2
from rosbags.typesys import Stores, get_typestore

import corvo

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
RECORDED_LATER_NS = 5_000_000


class BagFile:
    """A bag that is written in the format of its name: .bag, .mcap or a folder with SQLite."""

    def __init__(self, path: Path) -> None:
        self.is_ros1 = path.suffix == ".bag"
        self.store = get_typestore(Stores.ROS1_NOETIC if self.is_ros1 else Stores.ROS2_HUMBLE)
        plugins = rosbag2.StoragePlugin
        plugin = plugins.MCAP if path.suffix == ".mcap" else plugins.SQLITE3
        self.writer: Any = (
            rosbag1.Writer(path)
            if self.is_ros1
            else rosbag2.Writer(path, version=8, storage_plugin=plugin)
        )
        self.connections: dict[str, Any] = {}

    def __enter__(self) -> Self:
        self.writer.open()
        return self

    def __exit__(self, *_: object) -> None:
        self.writer.close()

    def header(self, time_ns: int) -> Any:
        types = self.store.types
        stamp = types["builtin_interfaces/msg/Time"](*divmod(time_ns, 10**9))
        extra = {"seq": 0} if self.is_ros1 else {}
        return types["std_msgs/msg/Header"](stamp=stamp, frame_id="camera", **extra)

    def write(self, topic: str, kind: str, time_ns: int, **fields: Any) -> None:
        """Writes a message that was recorded later than the time in its header."""
        if topic not in self.connections:
            connection = self.writer.add_connection(topic, kind, typestore=self.store)
            self.connections[topic] = connection
        message = self.store.types[kind](header=self.header(time_ns), **fields)
        serialize = self.store.serialize_ros1 if self.is_ros1 else self.store.serialize_cdr
        data = serialize(message, kind)
        self.writer.write(self.connections[topic], time_ns + RECORDED_LATER_NS, data)

    def write_image(
        self,
        topic: str,
        time_ns: int,
        encoding: str,
        pixels: NDArray[Any],
        step: int = 0,
        is_bigendian: int = 0,
    ) -> None:
        height, width = pixels.shape[:2]
        row = np.ascontiguousarray(pixels).reshape(height, -1).view(np.uint8)
        padded = np.zeros((height, step or row.shape[1]), np.uint8)
        padded[:, : row.shape[1]] = row
        self.write(
            topic,
            IMAGE,
            time_ns,
            height=height,
            width=width,
            encoding=encoding,
            is_bigendian=is_bigendian,
            step=padded.shape[1],
            data=padded.ravel(),
        )

    def write_compressed(self, topic: str, time_ns: int, data: bytes) -> None:
        self.write(topic, COMPRESSED, time_ns, format="png", data=np.frombuffer(data, np.uint8))

    def write_camera(
        self,
        topic: str,
        camera: corvo.Camera,
        distortion: list[float] = [0.0] * 5,
        model: str = "plumb_bob",
        **more: int,
    ) -> None:
        values = camera.parameters
        matrix = [values["fx"], 0, values["cx"], 0, values["fy"], values["cy"], 0, 0, 1]
        projection = np.insert(np.reshape(matrix, (3, 3)), 3, 0, axis=1).ravel()
        arrays = {"D": distortion, "K": matrix, "R": np.eye(3).ravel(), "P": projection}
        if not self.is_ros1:
            arrays = {name.lower(): value for name, value in arrays.items()}
        roi = {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}
        fields = {
            "width": camera.width,
            "height": camera.height,
            "distortion_model": model,
            "binning_x": 0,
            "binning_y": 0,
            "roi": self.store.types["sensor_msgs/msg/RegionOfInterest"](**roi),
            **{name: np.array(value, float) for name, value in arrays.items()},
        }
        self.write(topic, CAMERA_INFO, 1, **fields | more)
