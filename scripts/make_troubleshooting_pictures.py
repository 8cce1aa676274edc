# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/troubleshooting.md from rendered sequences.

    .venv/bin/python scripts/make_troubleshooting_pictures.py [--corvo PROGRAM] [--output FOLDER]

Needs `corvo` (built as in the README), gnuplot, and Python with numpy and Pillow, both of which
`scripts/install_dependencies.sh --development` installs in .venv.
"""
import argparse
import csv
import io
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

WIDTH = 900  # Of every picture, px.


class Sequence:
    """A sequence in TUM RGB-D layout: gray images, a camera file and ground truth."""

    def __init__(self, folder):
        self.folder = folder
        lines = (folder / "rgb.txt").read_text().splitlines()
        self.files = [folder / line.split()[1] for line in lines if not line.startswith("#")]

    def change(self, function):
        """Replaces image i by function(i, image)."""
        for i, file in enumerate(self.files):
            function(i, Image.open(file).convert("L")).save(file)
        return self


class Run:
    """A run of corvo with its drawings and tables."""

    def __init__(self, corvo, sequence):
        self.folder = sequence.folder.with_name(sequence.folder.name + "_result")
        self.drawings = self.folder.with_name(self.folder.name + "_drawings")
        command = [corvo, "run", sequence.folder, "-o", self.folder, "--draw", self.drawings]
        camera = ["--camera", sequence.folder / "camera.yaml"]
        subprocess.run(command + camera, check=False, capture_output=True)
        with open(self.folder / "frames.csv", encoding="utf-8") as table:
            self.frames = list(csv.DictReader(table))

    def drawing(self, frame):
        return Image.open(self.drawings / f"{frame:06}.jpg")

    def frames_with(self, reason):
        return [int(frame["index"]) for frame in self.frames if frame["reason"] == reason]


def render(corvo, scene, folder, *options):
    command = [corvo, "synth", scene, "-o", folder, "--width", str(WIDTH), *options]
    subprocess.run(command, check=True, capture_output=True)
    return Sequence(folder)


def positions(file):
    """Returns the times and positions of a TUM trajectory, one row per pose: t, x, y, z."""
    return np.loadtxt(file, usecols=(0, 1, 2, 3), comments="#")


def speeds(poses):
    """Returns the time and the speed of each pose but the first."""
    steps = np.diff(poses, axis=0)
    return poses[1:, 0], np.linalg.norm(steps[:, 1:], axis=1) / steps[:, 0]


# Disturbances of the rendered images.


def smooth_noise(width, height, amplitude, random):
    """Returns smooth noise of several sizes around 0."""
    noise = np.zeros((height, width))
    for cell in (6, 12, 40):
        size = (height // cell + 2, width // cell + 2)
        values = Image.fromarray(random.uniform(-1, 1, size).astype(np.float32))
        noise += np.asarray(values.resize((width, height), Image.Resampling.BILINEAR))
    return amplitude * noise


def make_lorry(width, height, random):
    """Returns the rear of a lorry with a printed tarpaulin."""
    lorry = np.full((height, width), 140.0) + smooth_noise(width, height, 35, random)
    image = Image.fromarray(lorry.clip(0, 255).astype(np.uint8))
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=height // 5)
    draw.text((width / 2, height * 0.35), "FREIGHT", 245, font, anchor="mm")
    draw.rectangle((0, 0, width - 1, height - 1), outline=30, width=5)
    draw.rectangle((0, height * 0.85, width, height), fill=45)
    for x in (0.04, 0.84):
        draw.rectangle((width * x, height * 0.87, width * (x + 0.12), height * 0.93), fill=230)
    return image


def add_lorry(sequence, frames, share, random):
    """Pastes a lorry that cuts in from the right, stays ahead and leaves."""
    size = Image.open(sequence.files[0]).size
    width, height = int(size[0] * share / 0.85), int(size[1] * 0.85)
    lorry = make_lorry(width, height, random)

    def paste(i, image):
        if i in frames:
            away = max(0, 1 - (i - frames.start) / 8, 1 - (frames.stop - 1 - i) / 8)
            x = (0.5 + away) * size[0] - width / 2 + 0.005 * size[0] * np.sin(i / 3)
            image.paste(lorry, (round(x), round(0.7 * (size[1] - height))))
        return image

    return sequence.change(paste)


def add_bonnet(sequence, random):
    """Pastes a bonnet that reflects a texture over the bottom of every image."""
    width, height = Image.open(sequence.files[0]).size
    texture = np.full((height, width), 90.0) + smooth_noise(width, height, 40, random)
    bonnet = Image.fromarray(texture.clip(0, 255).astype(np.uint8))
    shape = Image.new("L", (width, height))
    box = (-0.1 * width, 0.68 * height, 1.1 * width, 1.9 * height)
    ImageDraw.Draw(shape).ellipse(box, fill=255)
    return sequence.change(lambda i, image: Image.composite(bonnet, image, shape))


def repeat(sequence, times):
    """Shows every image `times` times; the timestamps stay."""
    images = [Image.open(file).convert("L") for file in sequence.files]
    return sequence.change(lambda i, image: images[i - i % times])


# Pictures.


def plot(script, height):
    """Returns the picture that a gnuplot script draws."""
    head = f"set terminal pngcairo size {WIDTH},{height} font 'sans,11'\nset grid\n"
    script = (head + script).encode()
    png = subprocess.run(["gnuplot"], input=script, check=True, capture_output=True)
    return Image.open(io.BytesIO(png.stdout)).convert("RGB")


def data_block(name, *columns):
    rows = "\n".join(" ".join(f"{value:.6f}" for value in row) for row in zip(*columns))
    return f"${name} << EOD\n{rows}\nEOD\n"


def label(image, text):
    """Writes a title on the upper border of an image."""
    font = ImageFont.load_default(size=18)
    draw = ImageDraw.Draw(image)
    box = draw.textbbox((8, 6), text, font)
    draw.rectangle((0, 0, box[2] + 8, box[3] + 6), fill="white")
    draw.text((8, 6), text, "black", font)
    return image


def beside(images):
    """Returns images of the same height beside each other, as wide as a picture."""
    result = Image.new("RGB", (WIDTH, images[0].height), "white")
    for image, x in zip(images, (0, WIDTH - images[-1].width)):
        result.paste(image, (x, 0))
    return result


def stack(images):
    """Returns images below each other."""
    gap = 6
    height = sum(image.height + gap for image in images) - gap
    result = Image.new("RGB", (max(image.width for image in images), height), "white")
    y = 0
    for image in images:
        result.paste(image, (0, y))
        y += image.height + gap
    return result


def make_palette():
    """Returns an image with the palette of the pictures: grays and the colors of the drawings."""
    grays = [(v, v, v) for v in np.linspace(0, 255, 18).round().astype(int)]
    colors = [(51, 99, 141), (41, 123, 142), (32, 146, 140), (36, 170, 131), (70, 192, 111)]
    colors += [(124, 210, 80), (189, 223, 38), (253, 231, 37)]  # The ages of tracks.
    colors += [(255, 200, 60), (230, 159, 0)]  # A state with a reason, the camera.
    masked = np.linspace(0, 255, 8)[:, None] * 0.6 + 0.4 * np.array([213, 94, 0])
    colors += [tuple(color) for color in masked.round().astype(int)]
    colors += [(48, 96, 192), (224, 112, 0), (255, 208, 144)]  # Curves.
    palette = Image.new("P", (1, 1))
    palette.putpalette([int(value) for color in grays + colors for value in color])
    return palette


def save(image, file):
    image.quantize(palette=make_palette(), dither=Image.Dither.NONE).save(file, optimize=True)
    print(f"{file}: {file.stat().st_size // 1000} kB")


def draw_static_overlay(corvo, work, file):
    street = render(corvo, "street", work / "overlay", "--frames", "40")
    run = Run(corvo, add_bonnet(street, np.random.default_rng(1)))
    masked = [float(frame["masked"]) > 0 for frame in run.frames].index(True)
    before, after = masked - 2, masked + 8
    titles = {before: "keypoints on the bonnet stay in place", after: "the bonnet is masked"}
    save(stack([label(run.drawing(i), f"Frame {i}: {titles[i]}") for i in titles]), file)


def draw_repeated_image(corvo, work, file):
    street = render(corvo, "street", work / "repeated", "--frames", "60")
    run = Run(corvo, repeat(street, 2))
    poses = positions(run.folder / "trajectory.tum")[30:51]
    distance = np.linalg.norm(poses[:, 1:] - poses[0, 1:], axis=1)
    frame = np.round(10 * poses[:, 0])
    repeats = np.isin(frame, run.frames_with("repeated_image"))
    script = data_block("all", frame, distance)
    script += data_block("new", frame[~repeats], distance[~repeats])
    script += data_block("repeat", frame[repeats], distance[repeats])
    script += """set key top left; set xlabel 'frame'; set ylabel 'distance traveled'; unset ytics
plot $all with lines lc rgb '#b0b0b0' notitle, \\
  $new with points pt 7 ps 1.4 lc rgb '#3060c0' title 'none', \\
  $repeat with points pt 6 ps 1.6 lw 2 lc rgb '#e07000' title 'repeated\\_image'
"""
    images = [label(run.drawing(i).crop((0, 0, 445, 270)), f"Frame {i}") for i in (40, 41)]
    save(stack([beside(images), plot(script, 260)]), file)


def speed_plot(sequence, run, num_known):
    """Returns the plot of the speed, with the unit of its first `num_known` frames."""
    time, speed = speeds(positions(run.folder / "trajectory.tum"))
    true_time, true_speed = speeds(positions(sequence.folder / "groundtruth.txt"))
    unit = np.median(true_speed[:num_known]) / np.median(speed[:num_known])
    script = data_block("truth", 10 * true_time, true_speed)
    script += data_block("run", 10 * time, unit * speed)
    for frame in run.frames_with("scale_uncertain"):
        script += (f"set object rectangle from {frame - 0.5}, graph 0 to {frame + 0.5}, graph 1 "
                   "fc rgb '#ffd090' fs solid noborder behind\n")
    return plot(script + """set xlabel 'frame'; set ylabel 'speed [m/s]'
set yrange [0:20]; set key top left
plot $truth with lines lw 4 lc rgb '#b0b0b0' title 'ground truth', \\
  $run with lines lw 2 lc rgb '#3060c0' title 'estimate', \\
  NaN with boxes fs solid lc rgb '#ffd090' title 'scale\\_uncertain'
""", 260)


def draw_scale_uncertain(corvo, work, file):
    street = render(corvo, "street", work / "lorry", "--frames", "90")
    lorry = range(40, 140)
    run = Run(corvo, add_lorry(street, lorry, 0.47, np.random.default_rng(2)))
    frame = run.frames_with("scale_uncertain")[-1]
    drawing = label(run.drawing(frame), f"Frame {frame}: a lorry drives ahead at the same speed")
    save(stack([drawing, speed_plot(street, run, lorry.start)]), file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--corvo", type=Path, default="build/release/apps/corvo")
    parser.add_argument("--output", type=Path, default="docs")
    arguments = parser.parse_args()
    work = Path(tempfile.mkdtemp())
    try:
        for draw in (draw_static_overlay, draw_repeated_image, draw_scale_uncertain):
            name = draw.__name__.replace("draw_", "troubleshooting_") + ".png"
            draw(arguments.corvo, work, arguments.output / name)
    finally:
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
