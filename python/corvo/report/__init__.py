# SPDX-License-Identifier: MIT
"""A page about results, which a browser shows without a network: `pip install corvo[report]`."""

from corvo.report.writer import write_report

__all__ = ["write_report"]
