# SPDX-License-Identifier: MIT
"""Pieces of HTML. Every text that is given is escaped; `code` becomes code."""

import base64
import html
import re
from collections.abc import Iterable, Sequence


_SHORT = 20
"""Cells of so many characters stay on one line."""


_LONG = 60
"""Cells of so many characters are wider."""


class Markup(str):
    """HTML that is not escaped again."""


def markup(text: object) -> str:
    """Returns the HTML of a text, in which backticks enclose code."""
    if isinstance(text, Markup):
        return text
    return re.sub("`([^`]+)`", r"<code>\1</code>", html.escape(str(text)))


def breakable(path: object) -> Markup:
    """Returns the HTML of a path that may continue on a new line after each slash."""
    return Markup(markup(path).replace("/", "/<wbr>"))


def attribute(text: object) -> str:
    return html.escape(str(text))


def paragraph(text: object) -> str:
    return f"<p>{markup(text)}</p>\n"


def bullets(texts: Iterable[object]) -> str:
    return "<ul>\n" + "".join(f"<li>{markup(text)}</li>\n" for text in texts) + "</ul>\n"


def details(summary: str, content: str) -> str:
    """Returns content that a reader unfolds."""
    return f"<details>\n<summary>{markup(summary)}</summary>\n{content}</details>\n"


def table(caption: str, header: Sequence[object], rows: Iterable[Sequence[object]]) -> str:
    """Returns a table whose first column has the headers of the rows. It scrolls by itself."""
    head = "".join(f'<th scope="col">{markup(cell)}</th>' for cell in header)
    body = "".join(f"<tr>{_cells(row)}</tr>\n" for row in rows)
    return (
        f'<div class="scroll" role="region" tabindex="0" aria-label="{attribute(caption)}">\n'
        f"<table>\n<caption>{markup(caption)}</caption>\n<thead><tr>{head}</tr></thead>\n"
        f"<tbody>\n{body}</tbody>\n</table>\n</div>\n"
    )


def picture(png: bytes, caption: str) -> str:
    """Returns a PNG image with a caption, which is its text for those who do not see it, too."""
    source = f"data:image/png;base64,{base64.b64encode(png).decode()}"
    image = f'<img src="{source}" alt="{attribute(caption)}">'
    return f"<figure>\n{image}\n<figcaption>{markup(caption)}</figcaption>\n</figure>\n"


def _cells(row: Sequence[object]) -> str:
    first, *others = row
    cells = "".join(f"<td{_class(cell)}>{markup(cell)}</td>" for cell in others)
    return f'<th scope="row">{markup(first)}</th>{cells}'


def _class(cell: object) -> str:
    length = len(str(cell))
    return ' class="short"' if length <= _SHORT else ' class="long"' if length >= _LONG else ""


def number(value: float, digits: int = 3) -> str:
    """Returns a number with so many significant digits, without an exponent from 0.0001 on."""
    if value == 0 or not 1e-4 <= abs(value) < 1e6:
        return f"{value:.{digits}g}"
    rounded = float(f"{value:.{digits}g}")
    return f"{rounded:.0f}" if abs(rounded) >= 10 ** (digits - 1) else f"{rounded:.{digits}g}"


def frame_range(first: int, last: int) -> str:
    return f"{first}" if first == last else f"{first}\N{EN DASH}{last}"
