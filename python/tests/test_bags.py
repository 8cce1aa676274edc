# SPDX-License-Identifier: MIT
"""Films in ROS bags, written with the package rosbags, give the results of the same image files."""

import os
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from rosbags import rosbag1, rosbag2
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

import corvo
from corvo import bags, pose_bag
from corvo._corvo import message_to_gray

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
START_NS = 1_403_636_579_763_555_584
STEP_NS = 33_333_333
ROS1 = get_typestore(Stores.ROS1_NOETIC)
ROS2 = get_typestore(Stores.ROS2_HUMBLE)


def command(*arguments):
    """Runs the command; returns its exit code and its messages."""
    done = subprocess.run(
        [sys.executable, "-m", "corvo", *map(str, arguments)], capture_output=True, text=True
    )
    return done.returncode, done.stderr


def run(*arguments):
    code, messages = command("run", *arguments)
    assert code == 0, messages


class BagFile:
    """A bag that is written in the format of its name: .bag, .mcap or a folder with SQLite."""

    def __init__(self, path):
        self.is_ros1 = path.suffix == ".bag"
        self.store = ROS1 if self.is_ros1 else ROS2
        if self.is_ros1:
            self.writer = rosbag1.Writer(path)
        else:
            plugins = rosbag2.StoragePlugin
            plugin = plugins.MCAP if path.suffix == ".mcap" else plugins.SQLITE3
            self.writer = rosbag2.Writer(path, version=8, storage_plugin=plugin)
        self.connections = {}

    def __enter__(self):
        self.writer.open()
        return self

    def __exit__(self, *_):
        self.writer.close()

    def header(self, time_ns):
        types = self.store.types
        stamp = types["builtin_interfaces/msg/Time"](*divmod(time_ns, 10**9))
        extra = {"seq": 0} if self.is_ros1 else {}
        return types["std_msgs/msg/Header"](stamp=stamp, frame_id="camera", **extra)

    def write(self, topic, kind, time_ns, **fields):
        """Writes a message that was recorded 5 ms after the time in its header."""
        if topic not in self.connections:
            self.connections[topic] = self.writer.add_connection(topic, kind, typestore=self.store)
        message = self.store.types[kind](header=self.header(time_ns), **fields)
        serialize = self.store.serialize_ros1 if self.is_ros1 else self.store.serialize_cdr
        self.writer.write(self.connections[topic], time_ns + 5_000_000, serialize(message, kind))

    def write_image(self, topic, time_ns, encoding, pixels, step=None, is_bigendian=0):
        height, width = pixels.shape[:2]
        row = pixels.reshape(height, -1).view(np.uint8)
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

    def write_compressed(self, topic, time_ns, data, form="png"):
        self.write(topic, COMPRESSED, time_ns, format=form, data=np.frombuffer(data, np.uint8))

    def write_camera(self, topic, camera, distortion=(0.0,) * 5, model="plumb_bob", **more):
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
        self.write(topic, CAMERA_INFO, START_NS, **fields | more)


class Film:
    """A rendered sequence: its images and camera, and the result of its files."""

    def __init__(self, folder):
        code, messages = command("synth", "room", "-o", folder, "--frames", 40, "--quiet")
        assert code == 0, messages
        files = sorted((folder / "rgb").glob("*.png"))
        self.images = [cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files]
        self.times = [START_NS + i * STEP_NS for i in range(len(files))]
        self.camera_file = folder / "camera.yaml"
        self.camera = corvo.Camera.load(self.camera_file)
        self.folder = folder
        self.expected = self.run_files(folder / "files", self.images)

    def run_files(self, folder, images):
        """Returns the trajectory of images that are stored as PNG."""
        folder.mkdir()
        for time_ns, image in zip(self.times, images):
            cv2.imwrite(str(folder / f"{time_ns}.png"), image)
        result = folder.parent / f"{folder.name}_result"
        run(folder, "--camera", self.camera_file, "-o", result)
        return (result / "trajectory.tum").read_bytes()

    def write(self, path, write_image):
        """Writes a bag with the camera. `write_image` writes an image with its time into it."""
        with BagFile(path) as bag:
            bag.write_camera("/cam/camera_info", self.camera)
            for time_ns, image in zip(self.times, self.images):
                write_image(bag, time_ns, image)
        return path

    def trajectory(self, path, *options):
        """Returns the trajectory of a bag."""
        result = path.with_name(path.name + "_result")
        run(path, "-o", result, *options)
        return (result / "trajectory.tum").read_bytes()


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    return Film(tmp_path_factory.mktemp("film") / "room")


def mono8(bag, time_ns, image):
    bag.write_image("/cam/image_raw", time_ns, "mono8", image)


def png(bag, time_ns, image):
    data = cv2.imencode(".png", image)[1].tobytes()
    bag.write_compressed("/cam/image_raw/compressed", time_ns, data)


@pytest.mark.parametrize("name", ["film.bag", "film.mcap", "film_sqlite"])
@pytest.mark.parametrize("write_image", [mono8, png])
def test_every_format_gives_the_trajectory_of_the_files(film, tmp_path, name, write_image):
    path = film.write(tmp_path / name, write_image)
    assert film.expected.count(b"\n") > 30
    assert film.trajectory(path) == film.expected


def test_the_storage_file_of_a_ros2_bag_can_be_given_alone(film, tmp_path):
    folder = film.write(tmp_path / "film", mono8)
    (storage,) = folder.glob("*.db3")
    assert film.trajectory(storage) == film.expected


@pytest.mark.parametrize(
    ("encoding", "channels"), [("bgr8", 3), ("rgb8", 3), ("bgra8", 4), ("rgba8", 4), ("8UC3", 3)]
)
def test_color_without_color_is_gray(film, tmp_path, encoding, channels):
    def write(bag, time_ns, image):
        pixels = np.repeat(image[:, :, None], channels, axis=2)
        bag.write_image("/cam/image_raw", time_ns, encoding, pixels)

    assert film.trajectory(film.write(tmp_path / "film.mcap", write)) == film.expected


@pytest.mark.parametrize("is_bigendian", [0, 1])
def test_16_bit_images_get_the_levels_of_16_bit_files(film, tmp_path, is_bigendian):
    wide = [7000 + 5 * image.astype(np.uint16) for image in film.images]
    expected = film.run_files(film.folder / f"wide{is_bigendian}", wide)
    wide = iter(wide)

    def write(bag, time_ns, _):
        pixels = next(wide).astype(">u2" if is_bigendian else "<u2")
        bag.write_image("/cam/image_raw", time_ns, "mono16", pixels, is_bigendian=is_bigendian)

    path = film.write(tmp_path / "film.bag", write)
    assert film.trajectory(path) == expected
    assert film.trajectory(path, "--bits", 14, "--force") != expected


def test_rows_may_be_padded(film, tmp_path):
    def write(bag, time_ns, image):
        bag.write_image("/cam/image_raw", time_ns, "mono8", image, step=image.shape[1] + 24)

    assert film.trajectory(film.write(tmp_path / "film.bag", write)) == film.expected


def message(encoding, pixels, **more):
    height, width = pixels.shape[:2]
    data = np.ascontiguousarray(pixels).reshape(-1).view(np.uint8)
    fields = {"width": width, "height": height, "step": data.size // height, **more}
    return bags.ImageMessage(0, data, encoding, **fields)


def test_colors_have_the_weights_of_the_command():
    rgb = np.random.default_rng(1).integers(0, 256, (40, 60, 3), np.uint8)
    expected = rgb @ [0.299, 0.587, 0.114]
    for encoding, pixels in [("rgb8", rgb), ("bgr8", rgb[:, :, ::-1])]:
        gray = message_to_gray(message(encoding, pixels), "image")
        assert gray.dtype == np.uint8
        assert np.abs(gray - expected).max() <= 0.51


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
@pytest.mark.parametrize(("suffix", "dtype", "unit"), [("8", np.uint8, 1), ("16", np.uint16, 256)])
def test_a_mosaic_becomes_the_gray_of_its_colors(pattern, suffix, dtype, unit):
    y, x = np.mgrid[:48, :64]
    rgb = np.stack([40 + 3 * x, 200 - 2 * y, 20 + x + y], axis=2) * unit
    mosaic = np.empty((48, 64), dtype)
    for i, color in enumerate(pattern):
        row, column = divmod(i, 2)
        mosaic[row::2, column::2] = rgb[row::2, column::2, "rgb".index(color)]
    gray = message_to_gray(message(f"bayer_{pattern}{suffix}", mosaic), "image")
    assert gray.shape == mosaic.shape and gray.dtype == dtype
    # Linear interpolation is exact on a linear image, up to rounding, but for the border.
    error = np.abs(gray - rgb @ [0.299, 0.587, 0.114])[2:-2, 2:-2]
    assert error.max() <= 1.5 * unit


@pytest.mark.parametrize(("encoding", "luma"), [("yuv422_yuy2", 0), ("yuv422", 1)])
def test_the_luma_of_yuv_is_gray(encoding, luma):
    pixels = np.random.default_rng(2).integers(0, 256, (20, 30, 2), np.uint8)
    gray = message_to_gray(message(encoding, pixels), "image")
    np.testing.assert_array_equal(gray, pixels[:, :, luma])


def test_a_damaged_image_costs_one_frame(film, tmp_path):
    def write(bag, time_ns, image):
        data = cv2.imencode(".png", image)[1].tobytes()
        cut = len(data) // 2 if time_ns == film.times[20] else len(data)
        bag.write_compressed("/cam/image_raw/compressed", time_ns, data[:cut])

    path = film.write(tmp_path / "film.mcap", write)
    film.trajectory(path)
    rows = (tmp_path / "film.mcap_result" / "frames.csv").read_text().splitlines()[1:]
    unreadable = [row.split(",")[0] for row in rows if row.split(",")[3] == "unreadable_image"]
    assert unreadable == ["20"] and len(rows) == len(film.images)
    assert command("run", path, "-o", tmp_path / "strict", "--strict")[0] == 1


def test_several_topics_need_a_name(film, tmp_path):
    def write(bag, time_ns, image):
        mono8(bag, time_ns, image)
        bag.write_image("/depth/image", time_ns, "16UC1", image.astype(np.uint16))

    path = film.write(tmp_path / "film.bag", write)
    code, messages = command("run", path, "-o", tmp_path / "none")
    assert code == 1 and "has 2 topics of images" in messages
    assert "--topic: /cam/image_raw, /depth/image" in messages
    code, messages = command("run", path, "-o", tmp_path / "none", "--topic", "/cam")
    assert code == 1 and "has no images in topic /cam; topics of images: /cam/image_raw" in messages
    assert film.trajectory(path, "--topic", "/cam/image_raw") == film.expected


def test_a_topic_of_anything_else_is_an_error(film, tmp_path):
    code, messages = command("run", film.folder / "files", "-o", tmp_path / "none", "--topic", "/a")
    assert code == 1 and "--topic /a: is for ROS bags" in messages


def test_a_bag_without_calibration_needs_a_camera(film, tmp_path):
    path = tmp_path / "film.mcap"
    with BagFile(path) as bag:
        for time_ns, image in zip(film.times, film.images):
            bag.write_image("/other/image_raw", time_ns, "mono8", image)
    code, messages = command("run", path, "-o", tmp_path / "none")
    assert code == 1 and "ships no calibration" in messages
    assert film.trajectory(path, "--camera", film.camera_file) == film.expected


@pytest.mark.parametrize(
    ("topic", "info", "expected"),
    [
        ("image_raw", {"distortion": [-0.2, 0.1, 0.01, 0.02, 0.0]}, {"k1": -0.2, "p2": 0.02}),
        ("image_raw", {"distortion": [0.1, 0.2, 0.3, 0.4], "model": "equidistant"}, {"k4": 0.4}),
        ("image_raw", {"distortion": [], "model": ""}, {"k1": 0}),
        ("image_rect", {"distortion": [-0.2, 0.1, 0, 0, 0]}, {"k1": 0}),
    ],
)
@pytest.mark.parametrize("name", ["film.bag", "film.mcap"])
def test_camera_info_is_the_calibration(film, tmp_path, name, topic, info, expected):
    path = tmp_path / name
    with BagFile(path) as bag:
        bag.write_camera("/cam/camera_info", film.camera, **info)
        bag.write_image(f"/cam/{topic}", START_NS, "mono8", film.images[0])
    file = tmp_path / "camera_info.json"
    file.write_text(bags.Bag(path).calibration)
    read = corvo.Camera.load(file).parameters
    for key in ("width", "height", "fx", "fy", "cx", "cy"):
        assert read[key] == film.camera.parameters[key]
    assert {key: read[key] for key in expected} == expected


def test_camera_info_of_binned_images_is_an_error(film, tmp_path):
    path = tmp_path / "film.mcap"
    with BagFile(path) as bag:
        bag.write_camera("/cam/camera_info", film.camera, binning_x=2, binning_y=2)
        bag.write_image("/cam/image_raw", START_NS, "mono8", film.images[0])
    with pytest.raises(corvo.Error, match="/cam/camera_info: is of binned images"):
        bags.Bag(path).calibration  # noqa: B018


@pytest.mark.parametrize("name", ["film.bag", "film.mcap", "film.db3"])
def test_damaged_bags_are_errors(film, tmp_path, name):
    whole = film.write(tmp_path / name.replace(".db3", ""), mono8)
    file = next(whole.glob("*.*3" if name.endswith("3") else "*.mcap")) if whole.is_dir() else whole
    damaged = tmp_path / f"damaged{Path(name).suffix}"
    damaged.write_bytes(file.read_bytes()[: os.path.getsize(file) // 2])
    code, messages = command("run", damaged, "-o", tmp_path / "none")
    assert code == 1 and f"corvo: error: {damaged}" in messages
    damaged.write_bytes(b"no bag")
    code, messages = command("run", damaged, "-o", tmp_path / "none")
    assert code == 1 and f"corvo: error: {damaged}" in messages


def test_without_rosbags_an_error_names_it(film, tmp_path, monkeypatch):
    path = film.write(tmp_path / "film.bag", mono8)
    monkeypatch.setitem(sys.modules, "rosbags.highlevel", None)
    with pytest.raises(corvo.Error, match=r"pip install corvo\[bags\]"):
        bags.Bag(path)


def test_a_loop_over_a_bag_has_the_images_and_their_times(film, tmp_path):
    def write(bag, time_ns, image):
        data = cv2.imencode(".png", image)[1].tobytes()
        cut = 100 if time_ns == film.times[1] else len(data)
        bag.write_compressed("/cam/image_raw/compressed", time_ns, data[:cut])

    bag = bags.Bag(film.write(tmp_path / "film.bag", write))
    assert len(bag) == len(film.images) and bag.topic == "/cam/image_raw/compressed"
    images, times = zip(*bag)
    assert list(times) == film.times
    assert images[1] is None
    np.testing.assert_array_equal(images[2], film.images[2])


@pytest.mark.parametrize("name", ["poses.bag", "poses.mcap", "poses"])
def test_poses_are_written_into_bags(film, tmp_path, name):
    result = film.folder / "files_result"
    path = tmp_path / name
    assert pose_bag.main([str(result), "-o", str(path)]) == 0
    with AnyReader([path]) as reader:
        read = [
            reader.deserialize(data, connection.msgtype)
            for connection, _, data in reader.messages()
        ]
        assert {connection.topic for connection in reader.connections} == {"/corvo/pose"}
    lines = film.expected.decode().splitlines()
    expected = [line.split() for line in lines if not line.startswith("#")]
    assert len(read) == len(expected)
    for pose, (time, *numbers) in zip(read, expected):
        stamp, point, turn = pose.header.stamp, pose.pose.position, pose.pose.orientation
        assert pose.header.frame_id == "corvo_segment_0"
        assert f"{stamp.sec}.{stamp.nanosec:09}" == time
        assert [point.x, point.y, point.z, turn.x, turn.y, turn.z, turn.w] == [*map(float, numbers)]


def test_poses_never_replace_a_file(film, tmp_path, capsys):
    path = tmp_path / "poses.mcap"
    path.write_bytes(b"mine")
    assert pose_bag.main([str(film.folder / "files_result"), "-o", str(path)]) == 1
    assert "exists already" in capsys.readouterr().err
    assert path.read_bytes() == b"mine"
    assert pose_bag.main([str(tmp_path), "-o", str(tmp_path / "new.bag")]) == 1
    assert "is not the result of a run" in capsys.readouterr().err
