# SPDX-License-Identifier: MIT
"""Colors and dashes that readers with any color vision tell apart, on light and dark pages."""

# From Okabe and Ito, "Color universal design", 2008; the order is that of the command's plots.
_COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
_DASHES = ("solid", "dash", "dot", "dashdot")

TRUTH = "#9A9A9A"
DOUBT = "#E69F00"

KINDS = {
    "tracked": ("#009E73", ""),
    "scale_uncertain": ("#E69F00", "x"),
    "rotation_only": ("#CC79A7", "-"),
    "initializing": ("#56B4E9", "/"),
    "lost": ("#D55E00", "\\"),
    "missing": ("#606060", "+"),
}
"""The color and the pattern of frames, by the keys of frames.KINDS."""


def line(index: int, variant: int = 0) -> dict[str, object]:
    """Returns the style of the line of a run or segment, and of a variant of it."""
    dash = (variant + index // len(_COLORS)) % len(_DASHES)
    return {"color": _COLORS[index % len(_COLORS)], "dash": _DASHES[dash], "width": 2}


def faint(index: int, opacity: float) -> str:
    """Returns the color of line(index) with an opacity from 0 to 1."""
    color = _COLORS[index % len(_COLORS)]
    red, green, blue = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return f"rgba({red},{green},{blue},{opacity})"
