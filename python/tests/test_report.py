# SPDX-License-Identifier: MIT
"""The page of `corvo report`: its numbers, texts and errors. A browser opens it in another file."""

import base64
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Sequence, command
from PIL import Image

import corvo

pytest.importorskip("plotly")
import plotly.graph_objects as go  # noqa: E402

from corvo.report import write_report  # noqa: E402
from corvo.report import colors  # noqa: E402
from corvo.report.camera import camera_history_figure  # noqa: E402
from corvo.report.figure import MAX_POINTS, encode, path, series  # noqa: E402
from corvo.report.frames import KINDS, Frames, find_spans  # noqa: E402
from corvo.report.html import number  # noqa: E402
from corvo.report.options import default_options, parse_options  # noqa: E402
from corvo.report.reasons import REASONS, STATES  # noqa: E402
from corvo.report.run import Run, open_runs  # noqa: E402
from corvo.report.sections import make_sections  # noqa: E402
from corvo.report.spans_table import MAX_ROWS  # noqa: E402
from corvo.report.world import find_axes  # noqa: E402

DOCS = Path(__file__).parents[2] / "docs"


def report(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "corvo", "report", *map(str, arguments)],
        capture_output=True,
        text=True,
    )


@pytest.fixture(scope="module")
def page(command_result: Path, tmp_path_factory: pytest.TempPathFactory) -> str:
    file = tmp_path_factory.mktemp("report") / "report.html"
    process = report(command_result, "-o", file)
    assert (process.returncode, process.stdout, process.stderr) == (0, "", "")
    return file.read_text()


@pytest.fixture(scope="module")
def run(command_result: Path) -> Run:
    return open_runs([corvo.Result(command_result)], "")[0]


@pytest.fixture(scope="module")
def lost(lost_result: Path) -> Run:
    return open_runs([corvo.Result(lost_result)], "")[0]


class Outline(HTMLParser):
    """The elements of a page with their attributes."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def of(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.elements if name == tag]


def without_plotly(html: str) -> str:
    from plotly.offline import get_plotlyjs

    assert html.count(get_plotlyjs()) == 1
    return html.replace(get_plotlyjs(), "")


def figures_of(html: str) -> list[dict[str, Any]]:
    found = re.search(r'id="figures">(.*?)</script>', html, re.S)
    assert found is not None
    figures: list[dict[str, Any]] = json.loads(found[1])
    return figures


def test_the_ate_is_that_of_the_evaluation(command_result: Path, page: str, run: Run) -> None:
    ate = corvo.evaluate(corvo.Result(command_result))["ate"]
    assert f"{number(ate['rmse'])} m ({number(ate['percent_of_path'])}% of the path)" in page
    assert np.sqrt(np.nanmean(run.errors**2)) == pytest.approx(ate["rmse"], rel=1e-9)
    assert np.nanmax(run.errors) == pytest.approx(ate["max"], rel=1e-9)


def test_the_aligned_path_is_as_far_from_the_truth_as_the_errors_say(run: Run) -> None:
    assert run.comparison is not None and run.true_path is not None
    is_known = np.isfinite(run.errors)
    offsets = run.positions[is_known] - run.true_path[: is_known.sum()]
    assert np.linalg.norm(offsets, axis=1) == pytest.approx(run.errors[is_known], abs=1e-6)


def test_another_truth_replaces_that_of_the_run(
    command_result: Path, room: Sequence, tmp_path: Path
) -> None:
    lines = (command_result / "groundtruth.tum").read_text().splitlines()
    rows = [line.split() for line in lines if not line.startswith("#")]
    doubled = [[t, *(str(2 * float(v)) for v in row[:3]), *row[3:]] for t, *row in rows]
    truth = tmp_path / "truth.tum"
    truth.write_text("".join(" ".join(row) + "\n" for row in doubled))
    result = corvo.Result(command_result)
    own, other = (open_runs([result], given)[0] for given in ("", truth))
    assert other.path_length == pytest.approx(2 * own.path_length, rel=1e-6)
    assert np.nanmax(other.errors) == pytest.approx(2 * np.nanmax(own.errors), rel=1e-6)


def test_expected_errors_have_the_scale_of_the_truth(command_result: Path, run: Run) -> None:
    assert run.comparison is not None
    scale = run.comparison.measures["truth_from_estimate"]["scale"]
    expected = corvo.Result(command_result).summary["expected_ate"]["rmse"]
    assert np.sqrt(np.nanmean(run.drift_sigma**2)) == pytest.approx(scale * expected, rel=1e-4)


def test_the_truth_is_compared_as_by_the_run(room: Sequence) -> None:
    result = corvo.run(room.folder, camera=room.camera, count=20, max_dt=0.0015)
    (run,) = open_runs([result], "")
    assert run.comparison is not None
    assert run.comparison.measures["max_dt_s"] == 0.0015


@pytest.mark.parametrize("up", [0, 1, 2])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_view_from_above_is_not_mirrored(up: int, sign: int) -> None:
    down = -sign * np.eye(3)[up]
    forward = np.eye(3)[(up + 1) % 3]
    camera = np.stack([np.cross(down, forward), down, forward], axis=-1)
    right_forward_up = find_axes(camera[np.newaxis]).apply(np.eye(3))
    assert np.linalg.det(right_forward_up) == pytest.approx(1)
    np.testing.assert_array_equal(right_forward_up[:, 2], -down)


def test_the_path_does_not_lead_from_one_segment_to_the_next(
    command_result: Path, tmp_path: Path, run: Run
) -> None:
    split = column("segment", "1", first=40)
    changed = edited(command_result, tmp_path / "changed", "frames.csv", split)
    (parted,) = open_runs([changed], "")
    step = np.linalg.norm(run.positions[40] - run.positions[39])
    assert step > 0
    assert parted.path_length == pytest.approx(run.path_length - step, rel=1e-9)
    assert parted.posed_segments == [0, 1]


def test_every_frame_is_in_one_span(lost: Run) -> None:
    frames = [i for span in lost.spans for i in range(span.first, span.last + 1)]
    assert frames == list(range(len(lost.frames)))
    for span in lost.spans:
        assert set(lost.frames.is_posed[span.first : span.last + 1]) == {span.is_posed}
        assert set(lost.frames.states[span.first : span.last + 1]) == {span.state}


def test_a_loss_is_told_with_its_reason_in_plain_words(lost_result: Path, tmp_path: Path) -> None:
    assert report(lost_result, "-o", tmp_path / "lost.html").returncode == 0
    html = (tmp_path / "lost.html").read_text()
    reasons = {row["reason"] for row in corvo.Result(lost_result).rows if row["posed"] == "0"}
    assert reasons
    for reason in reasons:
        assert f"<code>{reason}</code>" in html
        assert REASONS[reason].meaning.split("`")[0] in html
    lost_rows = [row for row in re.findall("<tr>.*?</tr>", html) if ">lost</td>" in row]
    assert lost_rows and all('<th scope="row">' in row for row in lost_rows)


def test_a_path_is_interrupted_where_frames_have_no_pose(lost: Run) -> None:
    posed = np.flatnonzero(lost.frames.is_posed)
    curve, _ = path(posed, lost.positions[posed])
    assert np.isnan(curve["x"]).sum() == (np.diff(posed) > 3).sum() > 0
    assert (curve["customdata"] == -1).sum() == np.isnan(curve["x"]).sum()


def test_texts_are_those_of_the_documentation() -> None:
    text = (DOCS / "troubleshooting.md").read_text()
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", text, re.M))
    assert set(REASONS) | set(STATES) == set(rows)
    for name, (meaning, remedy) in REASONS.items():
        assert f"| `{name}` | {meaning} | " in text
        assert remedy in text
    for name, meaning in STATES.items():
        assert f"| `{name}` | {meaning} |" in text


def test_every_kind_of_frame_has_a_color() -> None:
    assert set(colors.KINDS) == set(KINDS)


def frames_with(outcomes: list[tuple[str, str, bool]]) -> Frames:
    count = len(outcomes)
    return Frames(
        times_s=np.arange(count) / 30,
        states=[state for state, _, _ in outcomes],
        reasons=[reason for _, reason, _ in outcomes],
        segments=np.zeros(count, np.int64),
        is_posed=np.array([posed for _, _, posed in outcomes]),
        masked=np.zeros(count),
        drift_sigma=np.zeros(count),
    )


def test_repeated_images_do_not_interrupt_a_span() -> None:
    outcomes = [("tracking", ["none", "repeated_image"][i % 2], True) for i in range(10)]
    (span,) = find_spans(frames_with(outcomes))
    assert (span.first, span.last, span.reason, span.num_repeated) == (0, 9, "none", 5)


def test_kinds_of_frames() -> None:
    outcomes = {
        ("initializing", "low_parallax", False): "initializing",
        ("tracking", "none", True): "tracked",
        ("tracking", "scale_uncertain", True): "scale_uncertain",
        ("lost", "too_few_inliers", False): "lost",
        ("lost", "unreadable_image", False): "missing",
        ("rotation_only", "rotation_only", False): "rotation_only",
    }
    spans = find_spans(frames_with(list(outcomes)))
    assert [span.kind for span in spans] == list(outcomes.values())


def test_doubtful_spans_are_listed_with_the_reason(command_result: Path, tmp_path: Path) -> None:
    changed = edited(command_result, tmp_path / "changed", "summary.json", change_summary)
    html = "".join(section.html() for section in make_sections(open_runs([changed], "")))
    doubts = html[html.index('id="doubts"') : html.index('id="trajectories"')]
    for text in ("12–34", "56, 58–60", "within a factor of 1.6", "A warning &lt;of&gt; the run"):
        assert text in doubts
    assert "ended early, after 80 of 99 frames: interrupted by SIGINT" in doubts


def change_summary(text: str) -> str:
    summary = json.loads(text)
    summary["scale_uncertain"] = [[12, 34]]
    summary["least_certain"] = [[56, 56], [58, 60]]
    summary["warnings"] = ["A warning <of> the run"]
    guessed = {"index": 1, "first_frame": 70, "last_frame": 79, "num_poses": 10}
    summary["segments"].append({**guessed, "scale": {"from": "median_speed", "factor": 1.6}})
    summary |= {"complete": False, "ended_by": "interrupted by SIGINT", "frames_expected": 99}
    return json.dumps(summary)


def edited(source: Path, folder: Path, name: str, change: Callable[[str], str]) -> corvo.Result:
    """Returns a copy of a result with a changed file, and without its manifest."""
    shutil.copytree(source, folder)
    (folder / "manifest.json").unlink()
    file = folder / name
    file.write_text(change(file.read_text()))
    return corvo.Result(folder)


def column(name: str, value: str, first: int = 0) -> Callable[[str], str]:
    """Returns a change of a table: from a row on, a column has that value."""

    def change(text: str) -> str:
        header, *rows = [line.split(",") for line in text.splitlines()]
        for row in rows[first:]:
            row[header.index(name)] = value
        return "".join(",".join(row) + "\n" for row in [header, *rows])

    return change


def test_plots_are_those_that_plotly_knows(page: str) -> None:
    figures = figures_of(page)
    names = [figure["id"] for figure in figures]
    assert names == [
        "above-m", "space-m", "error-m", "relative-m", "frames", "camera-change",
        "camera-history-0", "time",
    ]  # fmt: skip
    for figure in figures:
        go.Figure(data=figure["data"], layout=figure["layout"])  # Raises for unknown attributes.


def test_the_camera_is_shown_over_time(command_result: Path) -> None:
    (run,) = open_runs([corvo.Result(command_result)], "")
    figure = camera_history_figure(run)
    assert figure is not None
    curves = {trace["name"]: trace for trace in figure.traces}
    k1, final = curves["k1"], run.summary["calibration"]["k1"]
    prior_sigma = 0.03
    assert (k1["x"][0], k1["y"][0], k1["error_y"]["array"][0]) == (0, 0, 1)
    assert k1["x"][-1] == run.summary["frames"] - 1
    assert k1["y"][-1] == pytest.approx((final["value"] - final["given"]) / prior_sigma, rel=1e-6)
    assert k1["error_y"]["array"][-2] == pytest.approx(final["sigma"] / prior_sigma, rel=1e-4)


def test_a_camera_without_a_history_has_none_in_the_report(
    command_result: Path, tmp_path: Path
) -> None:
    shutil.copytree(command_result, tmp_path / "old")
    (tmp_path / "old" / "camera_history.csv").unlink()
    (run,) = open_runs([corvo.Result(tmp_path / "old")], "")
    assert camera_history_figure(run) is None


def test_masked_areas_are_shown_if_there_are_any(command_result: Path, tmp_path: Path) -> None:
    changed = edited(command_result, tmp_path / "masked", "frames.csv", column("masked", "0.25"))
    Image.fromarray(np.zeros((4, 6), np.uint8)).save(changed.folder / "mask.png")
    sections = {section.name: section for section in make_sections(open_runs([changed], ""))}
    html = sections["masked"].html()
    assert "25.0% in the mean" in html
    assert "masked: black is what was masked in the last image" in html
    (png,) = re.findall('<img src="data:image/png;base64,([^"]*)"', html)
    assert base64.b64decode(png) == (changed.folder / "mask.png").read_bytes()


def test_latencies_in_real_time_are_shown(room: Sequence, tmp_path: Path) -> None:
    camera = room.folder / "camera.yaml"
    options = ["--camera", camera, "--realtime", "--count", 40, "-o", tmp_path / "live", "--quiet"]
    subprocess.run(command("run", room.folder, *options), check=False)
    (live,) = open_runs([corvo.Result(tmp_path / "live")], "")
    expected = live.timing.environment["realtime"]["latency_ms"]
    html = "".join(section.html() for section in make_sections([live]))
    cells = "<td[^>]*>(.*?)</td>.*<td[^>]*>(.*?)</td></tr>"
    row = re.search(f'<th scope="row">latency, .*?</th>{cells}', html)
    assert row is not None
    assert [float(cell) for cell in row.groups()] == pytest.approx(
        [expected["median"], expected["max"]], abs=0.051
    )
    assert "Images dropped in real time" in html


def test_changed_options_come_first(room: Sequence, tmp_path: Path) -> None:
    config = corvo.Options({"extractor": {"num_features": 777}})
    result = corvo.run(room.folder, camera=room.camera, config=config, count=20)
    html = "".join(section.html() for section in make_sections(open_runs([result], "")))
    changed = html.index("Options that differ from the defaults")
    others = html.index("Options with default values")
    found = re.search(r"<code>extractor.num_features</code></th><td[^>]*>0</td><td[^>]*>777<", html)
    assert found is not None
    row = found.start()
    assert changed < row < others
    assert html.count("<code>extractor.num_features</code>") == 1


def test_all_options_are_listed_with_their_meanings() -> None:
    options = default_options()
    assert len(options) > 20
    assert options["tracker.min_inliers"].value == "20"
    assert "landmarks" in options["tracker.min_inliers"].meaning
    assert all(option.meaning for option in options.values())
    assert parse_options(str(corvo.Options())) == options


def test_several_runs_are_in_one_table_and_in_the_legends(
    command_result: Path, lost_result: Path, tmp_path: Path
) -> None:
    assert report(command_result, lost_result, "-o", tmp_path / "two.html").returncode == 0
    html = (tmp_path / "two.html").read_text()
    assert '<th scope="col">result</th><th scope="col">lost</th>' in html
    legends = {trace["name"] for figure in figures_of(html) for trace in figure["data"]}
    assert {"result", "lost", "ground truth"} <= legends
    assert "<h1>corvo report: result, lost</h1>" in html


def test_results_of_equal_names_are_named_by_their_paths(
    command_result: Path, tmp_path: Path
) -> None:
    copy = tmp_path / command_result.name
    shutil.copytree(command_result, copy)
    runs = open_runs([corvo.Result(command_result), corvo.Result(copy)], "")
    assert [run.name for run in runs] == [str(command_result), str(copy)]


def test_the_page_has_the_same_bytes_again(command_result: Path, page: str, tmp_path: Path) -> None:
    again = write_report([corvo.Result(command_result)], tmp_path / "again.html")
    assert again.read_text() == page


def test_the_page_is_structured_for_everyone(page: str) -> None:
    outline = Outline(without_plotly(page))
    assert outline.of("html") == [{"lang": "en"}]
    assert len(outline.of("title")) == len(outline.of("h1")) == len(outline.of("main")) == 1
    assert len(outline.of("header")) == len(outline.of("nav")) == len(outline.of("footer")) == 1
    ids = [attributes["id"] for _, attributes in outline.elements if "id" in attributes]
    assert len(ids) == len(set(ids))
    links = {str(link["href"])[1:] for link in outline.of("a")}
    assert links <= set(ids)
    assert {section["id"] for section in outline.of("section")} == links - {"content"}
    plots = [div for div in outline.of("div") if "plot" in str(div.get("class")).split()]
    assert len(plots) == len(figures_of(page))
    assert all(div["role"] == "group" and len(str(div["aria-label"])) > 40 for div in plots)
    assert all(header["scope"] in ("col", "row") for header in outline.of("th"))
    regions = [div for div in outline.of("div") if div.get("class") == "scroll"]
    assert len(regions) == len(outline.of("table")) == len(outline.of("caption")) > 0
    assert all(div["tabindex"] == "0" and div["aria-label"] for div in regions)


def test_the_page_names_no_other_place(page: str) -> None:
    assert re.findall(r"""(?:src|href)=["'](?!#|data:)""", without_plotly(page)) == []
    assert "//" not in re.sub(r"<script.*?</script>", "", without_plotly(page), flags=re.S)


def test_browsers_are_told_to_load_and_send_nothing(page: str) -> None:
    policies = [m for m in Outline(without_plotly(page)).of("meta") if "http-equiv" in m]
    (policy,) = [str(meta["content"]) for meta in policies]
    assert policy.startswith("default-src 'none';") and "form-action 'none'" in policy
    assert re.findall(r"https?:|\*|'self'", policy) == []


def test_names_cannot_add_markup(command_result: Path, tmp_path: Path) -> None:
    folder = tmp_path / "<script>alert(1)<"
    shutil.copytree(command_result, folder)
    file = write_report([folder], tmp_path / "report.html")
    html = without_plotly(file.read_text())
    assert "<script>alert" not in html
    assert "&lt;script&gt;alert(1)&lt;" in html and "\\u003cscript>alert(1)\\u003c" in html


def wide_run(run: Run, count: int) -> Iterator[Any]:
    generator = np.random.default_rng(1)
    frames = np.arange(count)
    values = generator.normal(size=count)
    yield series(frames, frames.astype(float), values), values
    yield path(frames, generator.normal(size=(count, 3))), values


def test_long_curves_are_thinned_and_say_so(run: Run) -> None:
    count = 4 * MAX_POINTS
    (line, line_notes), values = next(wide_run(run, count))
    assert len(line["x"]) <= MAX_POINTS + 2
    assert line["y"].max() == np.float32(values.max())
    assert line["y"].min() == np.float32(values.min())
    assert line_notes == [
        "Of every 8 frames of long runs, the least and the greatest value are drawn."
    ]
    (_, (points, point_notes)) = [curve for curve, _ in wide_run(run, count)]
    assert len(points["x"]) <= MAX_POINTS + 2
    assert point_notes == ["Long paths are drawn through every 4th pose."]


def test_5000_frames_are_drawn_whole_in_less_than_10_mb(
    command_result: Path, tmp_path: Path
) -> None:
    file = write_report([long_result(command_result, tmp_path / "long", 5000)], tmp_path / "a.html")
    html = without_plotly(file.read_text())
    assert len(html) < 10e6
    assert "of long runs" not in html and "Long paths" not in html
    assert "5000 of 5000" in html


def long_result(source: Path, folder: Path, count: int) -> corvo.Result:
    """Returns a result whose frames are those of another one over and over, with later times."""
    shutil.copytree(source, folder)
    for name in ("manifest.json", "groundtruth.tum"):
        (folder / name).unlink()
    for name in ("frames.csv", "relative_poses.csv", "timing.csv"):
        repeat_table(folder / name, count)
    repeat_poses(folder / "trajectory.tum", count)
    summary = json.loads((folder / "summary.json").read_text())
    summary |= {"frames": count, "posed": count, "posed_share": 1.0}
    del summary["evaluation"]
    (folder / "summary.json").write_text(json.dumps(summary))
    return corvo.Result(folder)


def repeat_table(file: Path, count: int) -> None:
    header, *rows = file.read_text().splitlines()
    lines = [header]
    for i in range(count):
        fields = rows[i % len(rows)].split(",")
        fields[0] = str(i)
        if header.startswith("index,timestamp"):
            fields[1] = f"{i / 30:.9f}"
        if "posed" in header.split(","):
            fields[header.split(",").index("posed")] = "1"
        lines.append(",".join(fields))
    file.write_text("\n".join(lines) + "\n")


def repeat_poses(file: Path, count: int) -> None:
    rows = [line.split() for line in file.read_text().splitlines() if not line.startswith("#")]
    lines = [" ".join([f"{i / 30:.9f}", *rows[i % len(rows)][1:]]) for i in range(count)]
    file.write_text("\n".join(lines) + "\n")


def test_many_spans_are_cut_to_the_longest_and_say_so(lost: Run) -> None:
    outcomes = [("tracking", "none", True), ("lost", "too_few_matches", False)] * 300
    frames = frames_with(outcomes)
    shown = replace(lost, frames=frames, spans=find_spans(frames), **unknown_values(len(frames)))
    (account,) = [s for s in make_sections([shown]) if s.name == "account"]
    html = account.html()
    assert html.count("<tr>") == MAX_ROWS + 1
    assert f"The {MAX_ROWS} longest spans; 400 shorter ones are in" in html


def unknown_values(count: int) -> dict[str, Any]:
    """The arrays of a run over so many frames."""
    names = ("distances", "errors", "drift_sigma", "relative_sigma", "relative_sigma_deg")
    return {"positions": np.zeros((count, 3)), **{name: np.zeros(count) for name in names}}


def test_a_run_without_poses_has_a_page(room: Sequence, tmp_path: Path) -> None:
    folder = tmp_path / "black"
    folder.mkdir()
    for i in range(5):
        Image.fromarray(np.zeros((480, 640), np.uint8)).save(folder / f"{i}.png")
    options = ["--camera", room.folder / "camera.yaml", "-o", tmp_path / "none", "--quiet"]
    assert subprocess.run(command("run", folder, *options)).returncode == 2
    process = report(tmp_path / "none", "-o", tmp_path / "none.html")
    assert (process.returncode, process.stderr) == (0, "")
    html = (tmp_path / "none.html").read_text()
    assert "No frame has a pose." in html and "too_few_features" in html
    assert "See the reasons of the frames" in html and "no doubts" not in html
    assert [figure["id"] for figure in figures_of(html)] == ["frames", "time"]


def test_an_own_page_is_replaced_and_any_other_file_is_not(
    command_result: Path, tmp_path: Path
) -> None:
    file = tmp_path / "new folder" / "report.html"
    for _ in range(2):
        assert report(command_result, "-o", file).returncode == 0
    page = file.read_bytes()
    for foreign in (b"my notes", page + b" ", page[1:], b""):
        file.write_bytes(foreign)
        process = report(command_result, "-o", file)
        assert process.returncode == 1
        assert process.stderr == (
            f"corvo: error: {file}: not written by an earlier corvo, or changed since; nothing "
            "was replaced: choose another output, or use --force\n"
        )
        assert file.read_bytes() == foreign
    assert report(command_result, "-o", file, "--force").returncode == 0
    assert file.read_bytes() == page
    assert [path.name for path in file.parent.iterdir()] == ["report.html"]


def test_an_error_leaves_the_page_as_it_was(command_result: Path, tmp_path: Path) -> None:
    file = tmp_path / "report.html"
    assert report(command_result, "-o", file).returncode == 0
    page = file.read_bytes()
    assert report(command_result, tmp_path / "missing", "-o", file).returncode == 1
    assert file.read_bytes() == page
    assert [path.name for path in tmp_path.iterdir()] == ["report.html"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "the following arguments are required: RESULT, -o/--output"),
        (["{result}"], "the following arguments are required: -o/--output"),
        (["{result}", "-o", "{new}", "--every", "2"], "unrecognized arguments: --every 2"),
        (["{empty}", "-o", "{new}"], "{empty}: is not the result of a run; it has no frames.csv"),
        (["{result}", "--gt", "{empty}", "-o", "{new}"], "{empty}: no ground truth"),
        (["{result}", "-o", "{empty}"], "{empty}: is a folder; name the file of the page"),
        (["{result}", "-o", "{file}/a.html"], "{file}/a.html: cannot be written"),
    ],
)
def test_errors_name_what_is_wrong(
    arguments: list[str], message: str, command_result: Path, tmp_path: Path
) -> None:
    places = {"result": command_result, "new": tmp_path / "new.html"}
    places |= {"empty": tmp_path / "empty", "file": tmp_path / "file"}
    places["empty"].mkdir()
    places["file"].touch()
    process = report(*(argument.format(**places) for argument in arguments))
    assert process.returncode == 1
    assert process.stderr.startswith("corvo: error: " + message.format(**places))
    assert process.stderr.count("\n") == 1
    assert not places["new"].exists()


@pytest.mark.parametrize("name", ["frames.csv", "summary.json", "timing.csv"])
def test_a_damaged_result_is_an_error_that_names_it(
    name: str, command_result: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "damaged"
    edited(command_result, folder, name, lambda text: text[: len(text) // 2])
    process = report(folder, "-o", tmp_path / "no.html")
    assert process.returncode == 1
    assert process.stderr.startswith("corvo: error: ") and str(folder) in process.stderr
    assert not (tmp_path / "no.html").exists()


def test_without_plotly_the_error_names_the_extra() -> None:
    program = "import sys; sys.modules['plotly'] = None; sys.argv[1:] = ['report', 'x']\n"
    program += "from corvo.__main__ import main; sys.exit(main())"
    process = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert process.returncode == 1
    assert process.stderr == "corvo: error: plotly is not installed: pip install corvo[report]\n"


def test_plots_hold_no_numbers_that_browsers_cannot_read(run: Run) -> None:
    figures = [figure for section in make_sections([run]) for figure in section.figures()]
    json.loads(encode(figures), parse_constant=pytest.fail)
