# SPDX-License-Identifier: MIT
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Sequence

import corvo


@pytest.fixture(scope="module")
def views(room: Sequence) -> tuple[corvo.orb.Features, corvo.orb.Features]:
    extract = corvo.orb.Extractor()
    return extract(room.images[0]), extract(room.images[15])


def test_features_are_arrays_without_a_copy(
    views: tuple[corvo.orb.Features, corvo.orb.Features],
) -> None:
    features = views[0]
    assert len(features) == 1000
    assert (features.pixels.dtype, features.pixels.shape) == (np.float32, (1000, 2))
    assert (features.descriptors.dtype, features.descriptors.shape) == (np.uint8, (1000, 32))
    assert (features.octaves.dtype, features.octaves.max()) == (np.int32, 7)
    assert features.angles_deg.min() >= 0 and features.angles_deg.max() < 360
    assert np.shares_memory(features.pixels, features.pixels)
    assert not features.descriptors.flags.writeable


def test_arrays_outlive_their_features(room: Sequence) -> None:
    features = corvo.orb.Extractor()(room.images[0])
    descriptors = features.descriptors
    expected = descriptors.copy()
    del features
    np.testing.assert_array_equal(descriptors, expected)


def test_matches_are_mutual_nearest_neighbors(
    views: tuple[corvo.orb.Features, corvo.orb.Features],
) -> None:
    first, second = (view.descriptors for view in views)
    matches = corvo.orb.match(first, second)
    bits = np.unpackbits(first, axis=1)[:, None] != np.unpackbits(second, axis=1)[None]
    distances = bits.sum(axis=2)
    assert len(matches) > 50
    for query, train, distance in matches:
        assert distance == distances[query, train] == distances[query].min()
        assert distance == distances[:, train].min() <= 65


@pytest.mark.parametrize(
    "descriptors, message",
    [
        (np.zeros((3, 32), np.int32), "first has dtype int32; allowed is uint8"),
        (np.zeros((3, 16), np.uint8), r"first has shape \(3, 16\); allowed is \(n, 32\)"),
        (np.zeros((3, 64), np.uint8)[:, ::2], r"first has strides \(64, 2\); allowed"),
        ([0] * 32, "first has type list; allowed is a NumPy array"),
    ],
)
def test_descriptors_are_checked(descriptors: object, message: str) -> None:
    with pytest.raises(corvo.Error, match=message):
        corvo.orb.match(descriptors, np.zeros((3, 32), np.uint8))  # type: ignore[arg-type]


def test_descriptors_need_not_be_aligned(
    views: tuple[corvo.orb.Features, corvo.orb.Features],
) -> None:
    first, second = (view.descriptors for view in views)
    bytes_of_first = np.zeros(first.size + 1, np.uint8)
    unaligned = bytes_of_first[1:].reshape(first.shape)
    unaligned[:] = first
    np.testing.assert_array_equal(
        corvo.orb.match(unaligned, second), corvo.orb.match(first, second)
    )


def test_an_index_finds_what_was_added(
    views: tuple[corvo.orb.Features, corvo.orb.Features], tmp_path: Path
) -> None:
    index = corvo.orb.LshIndex()
    index.add(views[0].descriptors)
    index.add(views[1].descriptors)
    assert len(index) == 2000
    indices, distances = index.find_nearest(views[1].descriptors, k=2)
    assert indices.shape == distances.shape == (1000, 2)
    assert (distances[:, 0] == 0).all()
    index.save(tmp_path / "index")
    again = corvo.orb.LshIndex.load(tmp_path / "index")
    np.testing.assert_array_equal(again.find_nearest(views[1].descriptors, k=2)[0], indices)
    with pytest.raises(corvo.Error, match="k is 0; allowed is 1"):
        index.find_nearest(views[0].descriptors, k=0)
    with pytest.raises(corvo.Error, match="num_tables is 0; allowed is 1 to 12"):
        corvo.orb.LshIndex(num_tables=0)


def test_two_views_give_the_motion(
    room: Sequence, views: tuple[corvo.orb.Features, corvo.orb.Features]
) -> None:
    matches = corvo.orb.match(views[0].descriptors, views[1].descriptors)
    first = views[0].pixels[matches[:, 0]].astype(float)
    second = views[1].pixels[matches[:, 1]].astype(float)
    motion = corvo.two_view(first, second, room.camera)
    assert motion.reason == "none"
    first_from_second = motion.first_from_second
    assert first_from_second is not None
    assert np.linalg.norm(first_from_second[:3, 3]) == pytest.approx(1)
    projected = room.camera.project(motion.points)
    errors = np.linalg.norm(projected - first[motion.matches], axis=1)
    assert np.median(errors) < 1

    standing = corvo.two_view(first, first, room.camera)
    assert (standing.reason, standing.first_from_second) == ("low_parallax", None)
    with pytest.raises(corvo.Error, match="second has 3 pixels; allowed is"):
        corvo.two_view(first, second[:3], room.camera)


@pytest.mark.parametrize(
    "points, message",
    [
        (np.zeros((3, 2), np.float32), "NAME has dtype float32; allowed is float64"),
        (np.zeros((3, 2), np.int64), "NAME has dtype int64; allowed is float64"),
        (np.zeros((3, 2), ">f8"), "NAME has dtype >f8; allowed is float64"),
        (np.zeros((3, 4)), r"NAME has shape \(3, 4\); allowed is \(n, "),
        (np.zeros(2), r"NAME has shape \(2,\); allowed is \(n, "),
        ([[1.0, 2.0]], "NAME has type list; allowed is a NumPy array"),
        (None, "NAME has type NoneType; allowed is a NumPy array"),
    ],
)
def test_points_are_checked(room: Sequence, points: Any, message: str) -> None:
    valid = np.zeros((3, 2))
    calls: dict[str, Callable[[], object]] = {
        "first": lambda: corvo.two_view(points, valid, room.camera),
        "second": lambda: corvo.two_view(valid, points, room.camera),
        "points": lambda: room.camera.project(points),
        "pixels": lambda: room.camera.undistort(points),
    }
    for name, call in calls.items():
        with pytest.raises(corvo.Error, match=message.replace("NAME", name)):
            call()


def test_points_may_lie_apart(room: Sequence) -> None:
    points = np.random.default_rng(3).uniform(1, 2, (5, 3))
    expected = room.camera.project(points)
    np.testing.assert_array_equal(room.camera.project(np.asfortranarray(points)), expected)
    np.testing.assert_array_equal(room.camera.project(points[::-1]), expected[::-1])
    unaligned = np.frombuffer(b"\0" + points.tobytes(), np.float64, offset=1).reshape(5, 3)
    np.testing.assert_array_equal(room.camera.project(unaligned), expected)
    packed = np.zeros(5, [("tag", np.uint8), ("point", np.float64, 3)])["point"]
    with pytest.raises(corvo.Error, match=r"points has strides \(25, 8\); allowed is multiples"):
        room.camera.project(packed)


def test_cameras(room: Sequence, tmp_path: Path) -> None:
    camera = corvo.Camera(
        model="pinhole", width=640, height=480, fx=500, fy=510, cx=320, cy=240, k1=0.1,
        sigma={"focal": 0.01},
    )
    (tmp_path / "camera.yaml").write_text(str(camera))
    assert corvo.Camera.load(tmp_path / "camera.yaml") == camera
    assert (camera.model, camera.width, camera.height) == ("pinhole-radtan", 640, 480)
    assert camera.parameters["k1"] == 0.1
    assert camera.sigma == {"focal": 0.01}
    pixels = np.array([[10.0, 20.0], [320.0, 240.0]])
    rays = camera.undistort(pixels)
    np.testing.assert_allclose(camera.project(np.c_[rays, [1, 1]] * 3), pixels, atol=1e-9)
    assert np.isnan(camera.project(np.array([[0.0, 0.0, -1.0]]))).all()
    assert "tum_fr1" in corvo.shipped_cameras()
    assert corvo.Camera.load("tum_fr1").width == 640
    with pytest.raises(corvo.Error, match="fx is missing"):
        corvo.Camera(model="fov", width=640, height=480)  # type: ignore[call-arg]
    with pytest.raises(corvo.Error, match="no camera of this name .* shipped are .*tum_fr1"):
        corvo.Camera.load("tum")
