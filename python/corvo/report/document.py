# SPDX-License-Identifier: MIT
"""A page as a whole: its sections in a document that loads nothing."""

from collections.abc import Sequence
from importlib.resources import files

from plotly.offline import get_plotlyjs

from corvo.report.figure import Figure, encode
from corvo.report.html import attribute, markup
from corvo.report.section import Section

_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; form-action 'none'; base-uri 'none'"
)
"""A browser that follows it loads nothing from elsewhere, and sends nothing."""


def make_document(command: str, names: str, sections: Sequence[Section]) -> str:
    """Returns the HTML of a page that loads nothing from anywhere.

    Args:
        command: The command that writes it.
        names: What it is about.
        sections: Its content.
    """
    figures = [figure for section in sections for figure in section.figures()]
    return f"""<!DOCTYPE html>
<html lang="en">
{_head(command, names)}<body>
<a class="skip" href="#content">Skip to the content</a>
<header>
<h1>{command}: {markup(names)}</h1>
{_navigation(sections)}</header>
<main id="content" tabindex="-1">
<noscript><p>The plots need JavaScript; the tables do not.</p></noscript>
{"".join(section.html() for section in sections)}</main>
<footer>
<p>Written by <code>{command}</code>. This page contains plotly.js (MIT license).</p>
</footer>
{_scripts(figures)}</body>
</html>
"""


def _head(command: str, names: str) -> str:
    return f"""<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{_POLICY}">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="{command}">
<link rel="icon" href="data:,">
<title>{command}: {attribute(names)}</title>
<style>
{_asset("page.css")}</style>
</head>
"""


def _scripts(figures: list[Figure]) -> str:
    return f"""<script>
{get_plotlyjs()}
</script>
<script type="application/json" id="figures">{encode(figures)}</script>
<script>
{_asset("page.js")}</script>
"""


def _navigation(sections: Sequence[Section]) -> str:
    links = "".join(
        f'<li><a href="#{section.name}">{markup(section.title)}</a></li>\n' for section in sections
    )
    return f'<nav aria-label="Sections">\n<ul>\n{links}</ul>\n</nav>\n'


def _asset(name: str) -> str:
    return files("corvo.report").joinpath(name).read_text(encoding="utf-8")
