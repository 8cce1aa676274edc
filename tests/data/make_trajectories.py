#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the stored trajectories beside this file: a true path, and an estimate of it in another
world and scale, with noise, drift, missing poses and times that are a little off.

    make_trajectories.py    # Python's standard library is enough; the output is always the same
"""
import math
import pathlib
import random

HERE = pathlib.Path(__file__).parent
START_S = 1403636580.5


def multiply(a, b):
    """Product of two unit quaternions (w, x, y, z)."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw)


def turn(x, y, z):
    """The unit quaternion of a rotation vector."""
    angle = math.sqrt(x * x + y * y + z * z)
    if angle < 1e-12:
        return (1.0, 0.0, 0.0, 0.0)
    s = math.sin(angle / 2) / angle
    return (math.cos(angle / 2), s * x, s * y, s * z)


def rotate(q, v):
    conjugate = (q[0], -q[1], -q[2], -q[3])
    return multiply(multiply(q, (0.0, *v)), conjugate)[1:]


def matrix(q):
    columns = [rotate(q, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return [[columns[c][r] for c in range(3)] for r in range(3)]


def true_pose(i, step):
    """A winding path of about `step` a frame that also climbs and rolls."""
    heading = 0.9 * math.sin(0.021 * i)
    position = (25 * step * math.sin(0.04 * i), 4 * step * math.sin(0.05 * i), step * i)
    return multiply(turn(0, heading, 0), turn(0.1 * math.sin(0.07 * i), 0, 0.05)), position


def estimated_pose(pose, i, noise, rng):
    """The true pose in another world, at a drifting scale, with noise."""
    world, scale = turn(0.7, -1.1, 0.4), 0.31 * (1 + 2e-4 * i)
    q, t = pose
    q = multiply(q, turn(*(rng.gauss(0, 0.004) for _ in range(3))))
    t = tuple(x + rng.gauss(0, noise) for x in t)
    t = tuple(scale * x + shift for x, shift in zip(rotate(world, t), (3.0, -2.0, 11.0)))
    return multiply(world, q), t


def write_tum(name, rows):
    with open(HERE / name, "w", encoding="ascii") as file:
        file.write("# timestamp tx ty tz qx qy qz qw\n")
        for time_s, (q, t) in rows:
            numbers = (*t, *q[1:], q[0])
            file.write(f"{time_s:.6f} " + " ".join(f"{x:.12g}" for x in numbers) + "\n")


def write_kitti(name, poses):
    with open(HERE / name, "w", encoding="ascii") as file:
        for q, t in poses:
            rows = [(*row, x) for row, x in zip(matrix(q), t)]
            file.write(" ".join(f"{x:.15g}" for row in rows for x in row) + "\n")


def main():
    rng = random.Random(1)
    truth = [true_pose(i, 0.05) for i in range(160)]
    write_tum("truth.tum", [(START_S + 0.05 * i, pose) for i, pose in enumerate(truth)])
    write_tum("estimate.tum", [(START_S + 0.05 * i + rng.uniform(-0.003, 0.003),
                                estimated_pose(pose, i, 0.004, rng))
                               for i, pose in enumerate(truth) if i >= 7 and i % 23 != 0])
    truth = [true_pose(i, 1.3) for i in range(180)]
    write_kitti("truth.kitti", truth)
    write_kitti("estimate.kitti", [estimated_pose(pose, i, 0.05, rng)
                                   for i, pose in enumerate(truth)])


if __name__ == "__main__":
    main()
