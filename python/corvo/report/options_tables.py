# SPDX-License-Identifier: MIT
"""The options of runs: those that differ from the defaults first."""

from collections.abc import Sequence

from corvo.report.html import Markup, details, markup, paragraph, table
from corvo.report.options import Option, default_options
from corvo.report.run import Run


def options_tables(runs: Sequence[Run]) -> str:
    defaults = default_options()
    keys = dict.fromkeys(key for run in runs for key in run.options)
    rows = {key: _option_row(key, runs, defaults) for key in keys}
    changed = [key for key in keys if any(_differs(key, run, defaults) for run in runs)]
    header = ["Option", "Default", *(run.name for run in runs), "Meaning"]
    html = paragraph("All options have their default values.")
    if changed:
        html = table("Options that differ from the defaults", header, [rows[k] for k in changed])
    others = [rows[key] for key in keys if key not in changed and key in defaults]
    html += details(
        f"{len(others)} options with default values",
        table("Options with default values", header, others),
    )
    return html + _inputs(runs)


def _differs(key: str, run: Run, defaults: dict[str, Option]) -> bool:
    default = defaults.get(key)
    return default is None or key not in run.options or run.options[key].value != default.value


def _option_row(
    key: str, runs: Sequence[Run], defaults: dict[str, Option]
) -> list[object]:
    options, default = [run.options.get(key) for run in runs], defaults.get(key)
    meaning = next((option.meaning for option in (default, *options) if option), "")
    values = [option.value if option else "-" for option in (default, *options)]
    return [Markup(f"<code>{markup(key)}</code>"), *values, meaning]


def _inputs(runs: Sequence[Run]) -> str:
    keys = dict.fromkeys(key for run in runs for key in run.inputs)
    if not keys:
        return ""
    rows = [(key, *(run.inputs.get(key, "-") for run in runs)) for key in keys]
    return table("Input and scale", ["Key of summary.json", *(run.name for run in runs)], rows)
