# SPDX-License-Identifier: MIT
"""Tables of frames for pandas and pyarrow, which are optional."""

import io
from importlib import import_module
from typing import TYPE_CHECKING, Any

from corvo._corvo import Error

if TYPE_CHECKING:
    import pandas
    import pyarrow


def to_frame(csv: str) -> "pandas.DataFrame":
    """Returns a table of frames, the text of a frames.csv, as a pandas.DataFrame."""
    frame: pandas.DataFrame = _module("pandas").read_csv(io.StringIO(csv))
    return frame


def to_arrow(csv: str) -> "pyarrow.Table":
    """Returns a table of frames, the text of a frames.csv, as a pyarrow.Table."""
    return _module("pyarrow.csv").read_csv(io.BytesIO(csv.encode()))


def _module(name: str) -> Any:
    package = name.partition(".")[0]
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        raise Error(f"{package} is not installed: pip install {package}") from error
