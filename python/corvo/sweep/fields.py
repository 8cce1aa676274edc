# SPDX-License-Identifier: MIT
"""Values of a plan. Errors name the file, the field, the value and what is allowed."""

import math
from collections.abc import Collection, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

from corvo._corvo import Error


class Field:
    """A value of a plan.

    Args:
        place: The file and the path of the field in it, for messages.
        value: What the file has there.
    """

    def __init__(self, place: str, value: Any) -> None:
        self.place = place
        self.value = value

    def error(self, allowed: str) -> Error:
        return Error(f"{self.place} is {shown(self.value)}; allowed is {allowed}")

    def mapping(self, keys: Collection[str] = ()) -> "dict[str, Field]":
        """Returns the fields of a mapping. With `keys`, others are an error."""
        if not isinstance(self.value, Mapping):
            raise self.error("a mapping")
        for key in self.value:
            if not isinstance(key, str):
                raise Error(f"{self.place} has the key {shown(key)}; allowed is a text")
            if keys and key not in keys:
                raise Error(f"{self.place} has the unknown key {key}{_hint(key, keys)}")
        return {key: Field(self._below(key), value) for key, value in self.value.items()}

    def items(self) -> "list[Field]":
        """Returns the items of a list."""
        if not isinstance(self.value, Sequence) or isinstance(self.value, str):
            raise self.error("a list")
        return [Field(f"{self.place}[{i}]", value) for i, value in enumerate(self.value)]

    def items_or_self(self) -> "list[Field]":
        """Returns the items of a list, or the field itself if it is none."""
        return self.items() if isinstance(self.value, list) else [self]

    def text(self) -> str:
        if not isinstance(self.value, str) or not self.value:
            raise self.error("a text")
        return self.value

    def flag(self) -> bool:
        if not isinstance(self.value, bool):
            raise self.error("true or false")
        return self.value

    def integer(self, least: int, most: int) -> int:
        is_integer = isinstance(self.value, int) and not isinstance(self.value, bool)
        if not is_integer or not least <= self.value <= most:
            raise self.error(f"a whole number from {least} to {most}")
        return int(self.value)

    def number(self, least: float, most: float) -> float:
        is_number = isinstance(self.value, (int, float)) and not isinstance(self.value, bool)
        if not is_number or not math.isfinite(self.value) or not least <= self.value <= most:
            raise self.error(f"a number from {least:g} to {most:g}")
        return float(self.value)

    def _below(self, key: str) -> str:
        return f"{self.place}{'' if self.place.endswith(': ') else '.'}{key}"


def shown(value: object) -> str:
    """Returns a value as a message shows it."""
    if isinstance(value, bool):
        return str(value).lower()
    text = f'"{value}"' if isinstance(value, str) else repr(value)
    return text if len(text) <= 80 else text[:77] + "..."


def _hint(key: str, keys: Collection[str]) -> str:
    nearest = get_close_matches(key, keys, 1)
    return f"; did you mean {nearest[0]}?" if nearest else f"; allowed are {', '.join(keys)}"
