# SPDX-License-Identifier: MIT
"""A section of a page."""

from dataclasses import dataclass

from corvo.report.figure import Figure
from corvo.report.html import markup


@dataclass(frozen=True)
class Section:
    name: str
    title: str
    content: list[str | Figure]

    def html(self) -> str:
        parts = [part.html() if isinstance(part, Figure) else part for part in self.content]
        return (
            f'<section id="{self.name}" aria-labelledby="{self.name}-heading">\n'
            f'<h2 id="{self.name}-heading" tabindex="-1">{markup(self.title)}</h2>\n'
            f"{''.join(parts)}</section>\n"
        )

    def figures(self) -> list[Figure]:
        return [part for part in self.content if isinstance(part, Figure)]
