# SPDX-License-Identifier: MIT
"""The page of `corvo report` in a browser: Debian's Chromium, driven by Playwright."""

import io
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pytest
from PIL import Image

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytest.importorskip("plotly")
from corvo.report import write_report  # noqa: E402

_TIMEOUT_S = 20


class OpenPage(NamedTuple):
    """A page on a screen, with the errors on its console and the requests for anything else."""

    page: "Page"
    complaints: list[str]

    def wait_until(self, condition: str) -> None:
        """Waits by evaluations of the debugger: the policy of the page forbids its own."""
        end = time.monotonic() + _TIMEOUT_S
        while not self.page.evaluate(condition):
            assert time.monotonic() < end, f"{condition}: {self.complaints}"
            time.sleep(0.02)

    def press(self, key: str) -> str:
        """Presses a key. Returns the target, the label or the name of what then has the focus."""
        self.page.keyboard.press(key)
        focused: str = self.page.evaluate(
            """() => {
              const element = document.activeElement;
              return element.getAttribute("href") || element.ariaLabel || element.tagName;
            }"""
        )
        return focused


@pytest.fixture(scope="module")
def file(
    command_result: Path, lost_result: Path, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """The page about two runs, one of which was lost for a while."""
    folder = tmp_path_factory.mktemp("browser")
    return write_report([command_result, lost_result], folder / "report.html")


def open_page(browser: "Browser", file: Path, width: int, **options: Any) -> OpenPage:
    """Opens a page without a network and waits for its plots."""
    viewport = {"width": width, "height": 800}
    page = browser.new_context(viewport=viewport, offline=True, **options).new_page()
    opened = OpenPage(page, [])

    def hear(message: Any) -> None:
        if message.type == "error":
            opened.complaints.append(message.text)

    def watch(request: Any) -> None:
        if not request.url.startswith((file.as_uri(), "data:", "blob:")):
            opened.complaints.append(request.url)

    page.on("console", hear)
    page.on("pageerror", lambda error: opened.complaints.append(str(error)))
    page.on("request", watch)
    page.goto(file.as_uri())
    opened.wait_until("document.documentElement.dataset.drawn !== undefined")
    return opened


@pytest.fixture(scope="module")
def wide(browser: "Browser", file: Path) -> OpenPage:
    return open_page(browser, file, 1440, color_scheme="light")


@pytest.fixture(scope="module")
def narrow(browser: "Browser", file: Path) -> OpenPage:
    return open_page(browser, file, 360, color_scheme="dark", has_touch=True, is_mobile=True)


@pytest.fixture(params=["wide", "narrow"])
def either(request: pytest.FixtureRequest) -> OpenPage:
    opened: OpenPage = request.getfixturevalue(request.param)
    return opened


SIZES_OF_DRAWINGS = """
() => [...document.querySelectorAll('.plot')].map(plot => {
  const isSpatial = plot.id.startsWith('space');
  const drawing = plot.querySelector(isSpatial ? 'canvas' : 'svg.main-svg');
  const box = drawing ? drawing.getBoundingClientRect() : {width: 0, height: 0};
  const curves = plot.querySelectorAll('.trace path, .point path').length;
  return [plot.id, box.width, box.height, isSpatial ? 1 : curves];
})"""


def test_every_plot_is_drawn(either: OpenPage) -> None:
    drawings = either.page.evaluate(SIZES_OF_DRAWINGS)
    available = either.page.evaluate("document.querySelector('main').clientWidth") - 32
    assert len(drawings) >= 7
    for name, width, height, num_curves in drawings:
        assert width == pytest.approx(available, abs=1), name
        assert height >= 150 and num_curves > 0, name


def test_a_plot_in_three_dimensions_shows_the_path(wide: OpenPage) -> None:
    scene = wide.page.locator("#space-m canvas")
    scene.scroll_into_view_if_needed()
    picture = np.asarray(Image.open(io.BytesIO(scene.screenshot())).convert("RGB"), int)
    is_blue = np.abs(picture - (0, 114, 178)).max(axis=-1) < 48  # The color of the first run.
    assert is_blue.sum() > 100  # 0 without the path.


def test_the_page_is_not_wider_than_the_screen(either: OpenPage) -> None:
    for element in ("documentElement", "body"):
        assert either.page.evaluate(
            f"document.{element}.scrollWidth - document.documentElement.clientWidth"
        ) == 0


def test_nothing_is_loaded_and_no_error_is_on_the_console(either: OpenPage) -> None:
    assert either.complaints == []


def test_the_page_follows_the_preferred_colors(wide: OpenPage) -> None:
    color = "document.getElementById('error-m').layout.font.color"
    light = wide.page.evaluate(color)
    wide.page.emulate_media(color_scheme="dark")
    wide.wait_until(f"{color} !== '{light}'")
    background = wide.page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert all(int(channel) < 64 for channel in background[4:-1].split(","))
    wide.page.emulate_media(color_scheme="light")
    wide.wait_until(f"{color} === '{light}'")


def test_keys_reach_the_sections_and_the_tables(wide: OpenPage) -> None:
    sections = wide.page.eval_on_selector_all("main section", "all => all.map(one => one.id)")
    wide.page.focus(".skip")
    assert [wide.press("Tab") for _ in sections] == [f"#{name}" for name in sections]
    wide.page.focus("nav a[href='#account']")
    wide.press("Enter")
    wide.wait_until("location.hash === '#account'")
    wide.wait_until("Math.abs(document.getElementById('account').getBoundingClientRect().top) < 99")
    buttons = ["Zoom", "Pan", "Zoom in", "Zoom out", "Reset axes", "Download plot as a PNG"]
    reached = [wide.press("Tab") for _ in range(len(buttons) + 2)]
    assert reached == [*buttons, "Spans of result", "Spans of lost"]


def test_focused_buttons_of_a_plot_are_seen_and_work(wide: OpenPage) -> None:
    opacity = "getComputedStyle(document.querySelector('#frames .modebar-group')).opacity"
    end = "document.getElementById('frames').layout.xaxis.range[1]"
    wide.page.focus(".skip")
    wide.wait_until(f"{opacity} === '0'")
    before = wide.page.evaluate(end)
    wide.page.focus("#frames [aria-label='Zoom in']")
    wide.wait_until(f"{opacity} === '1'")
    wide.press("Enter")
    wide.wait_until(f"{end} < {before}")


def test_no_button_sends_a_plot_away(wide: OpenPage) -> None:
    labels = wide.page.eval_on_selector_all(
        ".modebar-btn", "all => [...new Set(all.map(one => one.ariaLabel))]"
    )
    assert set(labels) == {
        "Zoom", "Pan", "Zoom in", "Zoom out", "Reset axes", "Download plot as a PNG",
        "Orbital rotation", "Reset camera to default",
    }  # fmt: skip


def test_a_plot_is_saved_as_a_picture(wide: OpenPage) -> None:
    wide.page.focus("#frames [aria-label='Download plot as a PNG']")
    with wide.page.expect_download(timeout=1000 * _TIMEOUT_S) as download:
        wide.press("Enter")
    assert download.value.suggested_filename == "frames.png"
    assert Path(download.value.path()).read_bytes().startswith(b"\x89PNG")


def test_a_wide_table_scrolls_by_keys_on_a_phone(narrow: OpenPage) -> None:
    narrow.page.focus("[aria-label='Spans of lost']")
    narrow.press("ArrowRight")
    narrow.wait_until("document.activeElement.scrollLeft > 0")
