# SPDX-License-Identifier: MIT
"""The views that a recording opens with."""

import rerun.blueprint as rrb

_ACCUMULATED = ("world/path", "world/landmarks", "world/uncertainty")
"""Entities of which everything is shown that was logged until the time that is looked at."""


def make_blueprint() -> rrb.Blueprint:
    """Returns the layout: scene and state on the left, image and series on the right."""
    left = rrb.Vertical(_scene(), _states(), row_shares=[4, 1])
    image = rrb.Spatial2DView(name="Image", origin="world/camera/image")
    series = rrb.Tabs(
        rrb.TimeSeriesView(name="Matches", origin="series/matches"),
        rrb.TimeSeriesView(name="Latency", origin="series/latency"),
        rrb.TimeSeriesView(name="Parallax", origin="series/parallax"),
        rrb.TimeSeriesView(name="Focal length", origin="camera/fx"),
        rrb.TimeSeriesView(name="Distortion", contents=["camera/k1", "camera/k2", "camera/omega"]),
    )
    right = rrb.Vertical(image, series, row_shares=[3, 2])
    return rrb.Blueprint(
        rrb.Horizontal(left, right, column_shares=[3, 2]),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline="frame"),
    )


def _scene() -> rrb.Spatial3DView:
    until_now = rrb.VisibleTimeRanges(
        [
            rrb.VisibleTimeRange(
                timeline,
                start=rrb.TimeRangeBoundary.infinite(),
                end=rrb.TimeRangeBoundary.cursor_relative(),
            )
            for timeline in ("frame", "time")
        ]
    )
    return rrb.Spatial3DView(
        name="Scene",
        origin="world",
        overrides={entity: until_now for entity in _ACCUMULATED},
    )


def _states() -> rrb.StateTimelineView:
    return rrb.StateTimelineView(name="State", contents=["state", "reason"])
