# SPDX-License-Identifier: MIT
"""What a run may take."""

from dataclasses import dataclass

from corvo.sweep.fields import Field


@dataclass(frozen=True)
class Limits:
    """What a run may take. One that takes more is ended."""

    time_s: float = 3600
    memory_mb: int = 8192
    """Resident memory, in units of 2^20 bytes."""
    attempts: int = 3
    """A run that crashes or exceeds a limit is tried so often."""


def read_limits(field: Field) -> Limits:
    """Raises Error if a key is unknown, or a value has the wrong type or is out of range."""
    values = field.mapping(("time_s", "memory_mb", "attempts"))
    default = Limits()
    return Limits(
        values["time_s"].number(0.1, 10**7) if "time_s" in values else default.time_s,
        values["memory_mb"].integer(1, 10**7) if "memory_mb" in values else default.memory_mb,
        values["attempts"].integer(1, 100) if "attempts" in values else default.attempts,
    )
