# SPDX-License-Identifier: MIT
"""Changes to a sequence that preserve the scene."""

import math
from dataclasses import dataclass, fields
from itertools import product
from typing import Any

from corvo.sweep.fields import Field


@dataclass(frozen=True)
class Perturbation:
    """A change to a sequence. The defaults change nothing."""

    start: int = 0
    """Index of the first image."""
    stride: int = 1
    """Every stride-th image is used."""
    noise: float = 0
    """Standard deviation of Gaussian noise of every pixel, gray levels."""
    gain: float = 0
    """Brightness is multiplied by 1 + gain sin(2 pi i / 50) in the i-th image."""
    jpeg: int = 0
    """Quality of JPEG compression; none if 0."""
    reversal: bool = False
    """The last image comes first."""
    repetition: int = 0
    """Every repetition-th image comes twice; none if 0."""
    passes: int = 1
    """The sequence comes so often, with a cut in between."""
    overlay: float = 0
    """Share of the image, at its lower edge, that shows the same texture all the time."""

    @property
    def title(self) -> str:
        """What differs from the sequence as it is."""
        parts = {
            f"start {self.start}": self.start > 0,
            f"stride {self.stride}": self.stride > 1,
            f"noise {self.noise:g}": self.noise > 0,
            f"gain {100 * self.gain:g}%": self.gain > 0,
            f"JPEG {self.jpeg}": self.jpeg > 0,
            "reversal": self.reversal,
            f"repetition {self.repetition}": self.repetition > 0,
            f"{self.passes} passes": self.passes > 1,
            f"overlay {100 * self.overlay:g}%": self.overlay > 0,
        }
        return ", ".join(part for part, is_used in parts.items() if is_used) or "none"


def read_perturbations(field: Field) -> list[Perturbation]:
    """Returns the perturbations of a list, each once. A list of values stands for each of them.

    Raises:
        Error: A key is unknown, or a value has the wrong type or is out of range.
    """
    perturbations: dict[Perturbation, None] = {}
    for item in field.items():
        values = item.mapping([key.name for key in fields(Perturbation)])
        choices = [[_read(name, choice) for choice in _choices(value)]
                   for name, value in values.items()]  # fmt: skip
        for chosen in product(*choices):
            perturbations[Perturbation(**dict(zip(values, chosen)))] = None
    if not perturbations:
        raise field.error("a list that is not empty")
    return list(perturbations)


def _choices(field: Field) -> list[Field]:
    choices = field.items_or_self()
    if not choices:
        raise field.error("a value, or a list that is not empty")
    return choices


def _read(name: str, field: Field) -> Any:
    match name:
        case "start":
            return field.integer(0, 10**9)
        case "stride":
            return field.integer(1, 10**9)
        case "noise":
            return field.number(0, 255)
        case "gain":
            return field.number(0, 1)
        case "jpeg":
            return field.integer(1, 100)
        case "reversal":
            return field.flag()
        case "repetition":
            return field.integer(1, 10**9)
        case "passes":
            return field.integer(1, 1000)
        case _:
            return field.number(0, 0.9)


def gain_factor(perturbation: Perturbation, index: int) -> float:
    """Returns the factor of the brightness of the image with an index."""
    return 1 + perturbation.gain * math.sin(2 * math.pi * index / 50)
