# SPDX-License-Identifier: MIT
"""Films in ROS bags give the results of the same images in files."""

import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bag_file import BagFile
from conftest import Sequence
from numpy.typing import NDArray
from PIL import Image

import corvo
from corvo import bags
from corvo._corvo import ResultImages, message_to_gray

START_NS = 1_403_636_579_763_555_584
TOPIC = "/cam/image_raw"
Pixels = NDArray[Any]
WriteImage = Callable[[BagFile, int, Pixels], None]


def encoded(image: Pixels) -> bytes:
    file = io.BytesIO()
    Image.fromarray(image).save(file, "png")
    return file.getvalue()


def trajectory(path: Path, **options: Any) -> bytes:
    result = corvo.run(path, **options)
    return (result.folder / "trajectory.tum").read_bytes()


class Film:
    """A rendered film whose times are those of a clock, and the trajectory of its files."""

    def __init__(self, room: Sequence, folder: Path) -> None:
        self.images = room.images[:40]
        self.times = [START_NS + time_ns for time_ns in room.timestamps_ns[:40]]
        self.camera = room.camera
        self.files = folder / "files"
        self.expected = self.trajectory_of_files(self.files, self.images)

    def trajectory_of_files(self, folder: Path, images: list[Pixels]) -> bytes:
        folder.mkdir()
        for time_ns, image in zip(self.times, images):
            (folder / f"{time_ns}.png").write_bytes(encoded(image))
        return trajectory(folder, camera=self.camera)

    def write(self, path: Path, write_image: WriteImage) -> Path:
        """Writes a bag with the camera. `write_image` writes an image with its time into it."""
        with BagFile(path) as bag:
            bag.write_camera("/cam/camera_info", self.camera)
            for time_ns, image in zip(self.times, self.images):
                write_image(bag, time_ns, image)
        return path


@pytest.fixture(scope="module")
def film(room: Sequence, tmp_path_factory: pytest.TempPathFactory) -> Film:
    return Film(room, tmp_path_factory.mktemp("film"))


def mono8(bag: BagFile, time_ns: int, image: Pixels) -> None:
    bag.write_image(TOPIC, time_ns, "mono8", image)


def png(bag: BagFile, time_ns: int, image: Pixels) -> None:
    bag.write_compressed(TOPIC + "/compressed", time_ns, encoded(image))


def png_cut_at(cut_ns: int) -> WriteImage:
    """Returns a writer of PNGs of which the one of this time is truncated."""

    def write(bag: BagFile, time_ns: int, image: Pixels) -> None:
        data = encoded(image)
        bag.write_compressed(TOPIC, time_ns, data[: 100 if time_ns == cut_ns else len(data)])

    return write


@pytest.mark.parametrize("name", ["film.bag", "film.mcap", "film_sqlite"])
@pytest.mark.parametrize("write_image", [mono8, png])
def test_every_format_gives_the_trajectory_of_the_files(
    film: Film, tmp_path: Path, name: str, write_image: WriteImage
) -> None:
    path = film.write(tmp_path / name, write_image)
    assert film.expected.count(b"\n") > 30
    assert trajectory(path) == film.expected


@pytest.mark.parametrize(("name", "suffix"), [("sqlite", ".db3"), ("mcap.mcap", ".mcap")])
def test_the_file_in_a_ros2_bag_can_be_given_alone(
    film: Film, tmp_path: Path, name: str, suffix: str
) -> None:
    (file,) = film.write(tmp_path / name, mono8).glob(f"*{suffix}")
    assert trajectory(file) == film.expected


@pytest.mark.parametrize(
    ("encoding", "channels"), [("bgr8", 3), ("rgb8", 3), ("bgra8", 4), ("rgba8", 4), ("8UC3", 3)]
)
def test_color_without_color_is_gray(
    film: Film, tmp_path: Path, encoding: str, channels: int
) -> None:
    def write(bag: BagFile, time_ns: int, image: Pixels) -> None:
        bag.write_image(TOPIC, time_ns, encoding, np.repeat(image[:, :, None], channels, axis=2))

    assert trajectory(film.write(tmp_path / "film.mcap", write)) == film.expected


@pytest.mark.parametrize(("dtype", "is_bigendian"), [("<u2", 0), (">u2", 1)])
def test_16_bit_images_get_the_levels_of_16_bit_files(
    film: Film, tmp_path: Path, dtype: str, is_bigendian: int
) -> None:
    def widened(image: Pixels) -> Pixels:
        return 7000 + 5 * image.astype(np.uint16)

    def write(bag: BagFile, time_ns: int, image: Pixels) -> None:
        pixels = widened(image).astype(dtype)
        bag.write_image(TOPIC, time_ns, "mono16", pixels, is_bigendian=is_bigendian)

    files = tmp_path / "files"
    expected = film.trajectory_of_files(files, [widened(image) for image in film.images])
    path = film.write(tmp_path / "film.bag", write)
    assert trajectory(path) == expected
    assert trajectory(path, bits=14) == trajectory(files, camera=film.camera, bits=14) != expected


def exported_images(result: corvo.Result, folder: Path) -> list[Pixels]:
    corvo.export(result, to="colmap", frames="all", images=True, output=folder)
    files = sorted((folder / "images").iterdir())
    assert [file.name for file in files] == [f"frame_{i:06}.jpg" for i in posed_frames(result)]
    return [np.asarray(Image.open(file)).astype(float) for file in files]


def posed_frames(result: corvo.Result) -> list[int]:
    return [int(row["index"]) for row in result.rows if row["posed"] == "1"]


@pytest.mark.parametrize("name", ["film.bag", "film.mcap", "film_sqlite"])
def test_the_images_of_a_result_are_exported(film: Film, tmp_path: Path, name: str) -> None:
    result = corvo.run(film.write(tmp_path / name, mono8))
    for index, image in zip(
        posed_frames(result), exported_images(result, tmp_path / "model"), strict=True
    ):
        assert np.abs(image - film.images[index]).mean() < 2  # The loss of JPEG.


def test_exported_images_have_the_size_and_the_levels_of_the_run(
    film: Film, tmp_path: Path
) -> None:
    def write(bag: BagFile, time_ns: int, image: Pixels) -> None:
        bag.write_image("/other", time_ns, "mono8", 255 - image)
        bag.write_image(TOPIC, time_ns, "mono16", 7000 + 5 * image.astype(np.uint16))

    path = film.write(tmp_path / "film.mcap", write)
    options = {"topic": TOPIC, "start": 3, "every": 2, "resize": 0.5}
    result = corvo.run(path, **options)
    used = [image for _, image, _ in ResultImages(result.folder)]
    for index, image in zip(
        posed_frames(result), exported_images(result, tmp_path / "model"), strict=True
    ):
        assert image.shape == (240, 320)
        expected = used[index]
        assert expected is not None
        assert np.abs(image - expected).mean() < 2


def test_rows_may_be_padded(film: Film, tmp_path: Path) -> None:
    def write(bag: BagFile, time_ns: int, image: Pixels) -> None:
        bag.write_image(TOPIC, time_ns, "mono8", image, step=image.shape[1] + 24)

    assert trajectory(film.write(tmp_path / "film.bag", write)) == film.expected


def message(encoding: str, pixels: Pixels) -> bags.ImageMessage:
    height, width = pixels.shape[:2]
    data = np.ascontiguousarray(pixels).reshape(-1).view(np.uint8)
    return bags.ImageMessage(0, data, encoding, width, height, step=data.size // height)


def luma(rgb: Pixels) -> Pixels:
    return rgb @ np.array([0.299, 0.587, 0.114])


def test_colors_have_the_weights_of_the_command() -> None:
    rgb = np.random.default_rng(1).integers(0, 256, (40, 60, 3), np.uint8)
    for encoding, pixels in [("rgb8", rgb), ("bgr8", rgb[:, :, ::-1])]:
        gray = message_to_gray(message(encoding, pixels), "image")
        assert gray.dtype == np.uint8
        assert np.abs(gray - luma(rgb)).max() <= 0.51


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
@pytest.mark.parametrize(("suffix", "dtype", "unit"), [("8", np.uint8, 1), ("16", np.uint16, 256)])
def test_a_mosaic_becomes_the_gray_of_its_colors(
    pattern: str, suffix: str, dtype: type, unit: int
) -> None:
    y, x = np.mgrid[:48, :64]
    rgb = np.stack([40 + 3 * x, 200 - 2 * y, 20 + x + y], axis=2) * unit
    mosaic = np.empty((48, 64), dtype)
    for i, color in enumerate(pattern):
        row, column = divmod(i, 2)
        mosaic[row::2, column::2] = rgb[row::2, column::2, "rgb".index(color)]
    gray = message_to_gray(message(f"bayer_{pattern}{suffix}", mosaic), "image")
    assert gray.shape == mosaic.shape and gray.dtype == dtype
    # Linear interpolation is exact on a linear image, up to rounding, but for the border.
    assert np.abs(gray - luma(rgb))[2:-2, 2:-2].max() <= 1.5 * unit


@pytest.mark.parametrize(("encoding", "channel"), [("yuv422_yuy2", 0), ("yuv422", 1)])
def test_the_luma_of_yuv_is_gray(encoding: str, channel: int) -> None:
    pixels = np.random.default_rng(2).integers(0, 256, (20, 30, 2), np.uint8)
    gray = message_to_gray(message(encoding, pixels), "image")
    np.testing.assert_array_equal(gray, pixels[:, :, channel])


def test_a_damaged_image_costs_one_frame(film: Film, tmp_path: Path) -> None:
    path = film.write(tmp_path / "film.mcap", png_cut_at(film.times[20]))
    frames = corvo.run(path).to_frame()
    assert frames.index[frames.reason == "unreadable_image"].tolist() == [20]
    assert len(frames) == len(film.images)
    with pytest.raises(corvo.Error, match="film.mcap, image 20: not a readable image"):
        corvo.run(path, strict=True)


def test_several_topics_need_a_name(film: Film, tmp_path: Path) -> None:
    def write(bag: BagFile, time_ns: int, image: Pixels) -> None:
        mono8(bag, time_ns, image)
        bag.write_image("/depth/image", time_ns, "16UC1", image.astype(np.uint16))

    path = film.write(tmp_path / "film.bag", write)
    with pytest.raises(corvo.Error, match="has 2 topics of images; .*: /cam/image_raw, /depth/im"):
        corvo.run(path)
    with pytest.raises(corvo.Error, match="no images in topic /cam; .*: /cam/image_raw, /depth/im"):
        corvo.run(path, topic="/cam")
    assert trajectory(path, topic=TOPIC) == film.expected


def test_a_bag_without_calibration_needs_a_camera(film: Film, tmp_path: Path) -> None:
    path = tmp_path / "film.mcap"
    with BagFile(path) as bag:
        for time_ns, image in zip(film.times, film.images):
            mono8(bag, time_ns, image)
    with pytest.raises(corvo.Error, match="ships no calibration"):
        corvo.run(path)
    assert trajectory(path, camera=film.camera) == film.expected


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
def test_camera_info_is_the_calibration(
    film: Film,
    tmp_path: Path,
    name: str,
    topic: str,
    info: dict[str, Any],
    expected: dict[str, float],
) -> None:
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


def test_camera_info_of_binned_images_is_an_error(film: Film, tmp_path: Path) -> None:
    path = tmp_path / "film.mcap"
    with BagFile(path) as bag:
        bag.write_camera("/cam/camera_info", film.camera, binning_x=2, binning_y=2)
        mono8(bag, START_NS, film.images[0])
    with pytest.raises(corvo.Error, match="/cam/camera_info: is of binned images"):
        corvo.run(path)


@pytest.mark.parametrize("name", ["film.bag", "film.mcap", "film_sqlite"])
@pytest.mark.parametrize("share", [0, 0.5])
def test_damaged_bags_are_errors(film: Film, tmp_path: Path, name: str, share: float) -> None:
    path = film.write(tmp_path / name, mono8)
    if path.is_dir():
        (path,) = (file for file in path.iterdir() if file.suffix != ".yaml")
    data = path.read_bytes()
    path.write_bytes(data[: int(len(data) * share)])
    with pytest.raises(corvo.Error, match=f"^{path}: is damaged or no ROS bag"):
        corvo.run(path)


def test_damage_part_way_keeps_the_result_until_then(film: Film, tmp_path: Path) -> None:
    path = film.write(tmp_path / "film.bag", mono8)
    data = bytearray(path.read_bytes())
    # The length of the frame id, which follows the stamp, of one image.
    seconds, nanoseconds = divmod(film.times[30], 10**9)
    stamp = seconds.to_bytes(4, "little") + nanoseconds.to_bytes(4, "little")
    data[data.index(stamp + b"\6\0\0\0camera") + 11] = 255
    path.write_bytes(data)
    with pytest.raises(corvo.Error, match=f"{path}: is damaged or no ROS bag"):
        corvo.run(path, output=tmp_path / "result")
    frames = (tmp_path / "result" / "frames.csv").read_text()
    assert frames.count("\n") == 31


def test_without_rosbags_an_error_names_it(
    film: Film, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = film.write(tmp_path / "film.bag", mono8)
    monkeypatch.setitem(sys.modules, "rosbags.highlevel", None)
    with pytest.raises(corvo.Error, match=r"pip install corvo\[bags\]"):
        corvo.run(path)


def test_a_loop_over_a_bag_has_the_images_and_their_times(film: Film, tmp_path: Path) -> None:
    bag = bags.Bag(film.write(tmp_path / "film.bag", png_cut_at(film.times[1])))
    assert len(bag) == len(film.images) and bag.topic == TOPIC
    images, times = zip(*bag)
    assert list(times) == film.times
    assert images[1] is None
    np.testing.assert_array_equal(images[2], film.images[2])
