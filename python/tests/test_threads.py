# SPDX-License-Identifier: MIT
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from conftest import Sequence

import corvo


def test_other_threads_advance_during_a_call() -> None:
    """A call that held the GIL would let the counter advance by nothing."""
    image = np.random.default_rng(1).integers(0, 256, (3000, 4000), dtype=np.uint8)
    extract = corvo.orb.Extractor(corvo.Options({"extractor": {"num_features": 20000}}))
    count = 0
    is_done = threading.Event()

    def advance() -> None:
        nonlocal count
        while not is_done.wait(0.001):
            count += 1

    counter = threading.Thread(target=advance)
    counter.start()
    before = count
    extract(image)
    advanced = count - before
    is_done.set()
    counter.join()
    assert advanced >= 3


def test_threads_may_share_an_odometry(room: Sequence) -> None:
    odometry = corvo.Odometry(room.camera)
    with ThreadPoolExecutor(4) as threads:
        readers = [threads.submit(odometry.trajectory) for _ in range(8)]
        frames = room.process(odometry)
        assert all(len(reader.result()) <= len(frames) for reader in readers)
    alone = room.process(corvo.Odometry(room.camera))
    np.testing.assert_array_equal(frames[-1].world_from_camera, alone[-1].world_from_camera)
