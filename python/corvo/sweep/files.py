# SPDX-License-Identifier: MIT
"""The names of the files of a sweep."""

ROWS = "rows.parquet"
"""What was measured: the same for every execution of a plan."""
RUNS = "runs.parquet"
"""Times, attempts, machines and the last lines of output: different every time."""
MEDIANS = "medians.md"
PAGE = "report.html"
