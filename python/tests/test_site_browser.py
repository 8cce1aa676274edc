# SPDX-License-Identifier: MIT
"""The documentation site in a browser, opened from its folder: without a server, without a network."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

SITE = Path(__file__).parents[2] / "build" / "site"


@pytest.fixture(scope="module")
def site() -> Path:
    """The folder of the built site; tests are skipped without it, or fail if CI is set."""
    if not (SITE / "index.html").exists():
        if os.environ.get("CI"):
            pytest.fail("scripts/build_site.sh has not been run")
        pytest.skip("scripts/build_site.sh has not been run")
    return SITE


def open_page(browser: "Browser") -> "tuple[Page, list[str]]":
    """Returns a page that is offline, and the list of its errors and of requests for anything else."""
    page = browser.new_context(viewport={"width": 400, "height": 800}, offline=True).new_page()
    page.set_default_timeout(120_000)  # Machines may be busy.
    complaints: list[str] = []

    def watch(request: Any) -> None:
        if not request.url.startswith((SITE.as_uri(), "data:", "blob:", "about:")):
            complaints.append(request.url)

    page.on("console", lambda m: complaints.append(m.text) if m.type == "error" else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", watch)
    return page, complaints


def test_every_page_is_whole_and_fits_a_phone(site: Path, browser: "Browser") -> None:
    page, complaints = open_page(browser)
    files = sorted({*site.glob("*.html"), *site.glob("d*/*.html")} - {site / "404.html"})
    assert len(files) > 20
    for file in files:
        page.goto(file.as_uri())
        width = page.evaluate("document.documentElement.scrollWidth")
        broken = page.evaluate("[...document.images].filter(i => !i.naturalWidth).map(i => i.src)")
        assert (complaints, broken, width) == ([], [], 400), file


def test_the_search_needs_no_server(site: Path, browser: "Browser") -> None:
    page, complaints = open_page(browser)
    page.goto((site / "running.html").as_uri())
    page.click("label[for=__search]")
    page.keyboard.type("parallax", delay=30)
    page.wait_for_selector(".md-search-result__item")
    assert "Troubleshooting" in page.inner_text(".md-search-result")
    assert complaints == []
