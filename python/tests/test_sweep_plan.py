# SPDX-License-Identifier: MIT
"""Plans of `corvo sweep`: what they allow, and which runs they name."""

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import fields, replace
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
from sweep_support import PACKAGES  # Skips without corvo[sweep].

import yaml

import corvo
from corvo.sweep.content import ContentHashes
from corvo.sweep.downloads import fetch
from corvo.sweep.inputs import Input
from corvo.sweep.limits import Limits
from corvo.sweep.options import OptionSet
from corvo.sweep.perturbation import Perturbation
from corvo.sweep.plan import Plan, read_plan
from corvo.sweep.tables import ROW_SCHEMA
from corvo.sweep.tasks import make_tasks

REPOSITORY = Path(__file__).parents[2]


def read(folder: Path, **given: Any) -> Plan:
    """Reads a plan with an input, unless others are given. JSON is a form of YAML."""
    (folder / "film.mp4").touch()
    file = folder / "plan.yaml"
    file.write_text(json.dumps({"inputs": [{"path": "film.mp4"}], **given}))
    return read_plan(file)


def test_a_plan_of_an_input_alone_is_one_run_with_default_options(tmp_path: Path) -> None:
    plan = read(tmp_path)
    assert plan.inputs == [Input(f"{tmp_path.name}/film.mp4", str(tmp_path / "film.mp4"))]
    assert [options.label for options in plan.options] == ["base"]
    assert plan.perturbations == [Perturbation()]
    assert plan.limits == Limits()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"input": []}, "has the unknown key input; did you mean inputs?"),
        ({"inputs": []}, "inputs is []; allowed is a list that is not empty"),
        ({"inputs": "film.mp4"}, 'inputs is "film.mp4"; allowed is a list'),
        ({"inputs": [{"name": "a"}]}, "inputs[0] has no path; allowed is a file, folder, pattern"),
        (
            {"inputs": [{"path": "none/*.mp4"}]},
            'inputs[0].path is "none/*.mp4"; allowed is a file, folder or pattern that exists',
        ),
        (
            {"inputs": [{"path": "$CORVO_NOT_SET/film.mp4"}]},
            "allowed is a text whose variables of the environment are set",
        ),
        ({"inputs": [{"path": "film.mp4"}] * 2}, "has two inputs of the name"),
        ({"inputs": [{"path": "film.mp4", "count": 0}]}, "inputs[0].count is 0; allowed is a "),
        ({"inputs": [{"path": "film.mp4", "fov": True}]}, "inputs[0].fov is true; allowed is a te"),
        (
            {"inputs": [{"path": "film.mp4", "report_only": ["stride 2"]}]},
            'has "stride 2"; allowed are the perturbations of the plan: none',
        ),
        ({"perturbations": []}, "perturbations is []; allowed is a list that is not empty"),
        ({"perturbations": [{"noise": [5, 300]}]}, "perturbations[0].noise[1] is 300; allowed is "),
        ({"perturbations": [{"noise": -1}]}, "noise is -1; allowed is a number from 0 to 255"),
        ({"perturbations": [{"noise": True}]}, "noise is true; allowed is a number from 0 to 255"),
        ({"perturbations": [{"gain": 1.5}]}, "gain is 1.5; allowed is a number from 0 to 1"),
        ({"perturbations": [{"jpeg": 0}]}, "jpeg is 0; allowed is a whole number from 1 to 100"),
        ({"perturbations": [{"start": 1.5}]}, "start is 1.5; allowed is a whole number from 0 to"),
        ({"perturbations": [{"stride": 0}]}, "stride is 0; allowed is a whole number from 1 to"),
        ({"perturbations": [{"reversal": 1}]}, "reversal is 1; allowed is true or false"),
        ({"perturbations": [{"passes": 0}]}, "passes is 0; allowed is a whole number from 1 to"),
        ({"perturbations": [{"repetition": 0}]}, "repetition is 0; allowed is a whole number"),
        ({"perturbations": [{"overlay": 1}]}, "overlay is 1; allowed is a number from 0 to 0.9"),
        ({"perturbations": [{"stride": []}]}, "allowed is a value, or a list that is not empty"),
        ({"perturbations": [{"nose": 5}]}, "perturbations[0] has the unknown key nose; did you me"),
        ({"options": {"base": {"num_features": 5}}}, "has the key num_features; allowed is secti"),
        ({"options": {"base": {"extractor.num": 5}}}, "options.base: unknown key extractor.num"),
        ({"options": {"grid": {"extractor.num_features": [-1]}}}, "options.grid: extractor.num_f"),
        ({"options": {"grid": {"extractor.grid": []}}}, "allowed is a mapping of fields to lists"),
        ({"metrics": ["ape"]}, "metrics[0] is ape; allowed are ate, "),
        ({"metrics": {"ate": -1}}, "metrics.ate is -1; allowed is a number from 0 to 10"),
        ({"limits": {"time_s": 0}}, "limits.time_s is 0; allowed is a number from 0.1 to"),
        ({"limits": {"memory_mb": "2G"}}, 'limits.memory_mb is "2G"; allowed is a whole number'),
        ({"limits": {"attempts": 0}}, "limits.attempts is 0; allowed is a whole number from 1"),
    ],
)
def test_an_error_names_file_field_value_and_what_is_allowed(
    tmp_path: Path, given: dict[str, Any], message: str
) -> None:
    with pytest.raises(corvo.Error) as caught:
        read(tmp_path, **given)
    assert str(caught.value).startswith(f"{tmp_path / 'plan.yaml'}: ")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("inputs: [", "is not YAML"),
        ("limits: {time_s: 1}\nlimits: {time_s: 2}\n", "line 1 has the key limits twice"),
        ("", "is None; allowed is a mapping"),
        ("limits: {time_s: 1}", "has no inputs; allowed is a list of them"),
    ],
)
def test_a_file_that_is_no_plan_is_an_error(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "plan.yaml"
    file.write_text(text)
    with pytest.raises(corvo.Error, match="plan.yaml.*" + message):
        read_plan(file)


def test_a_missing_plan_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(corvo.Error, match="none.yaml: cannot be read"):
        read_plan(tmp_path / "none.yaml")


def test_a_pattern_names_inputs_in_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("b", "a", "c"):
        (tmp_path / "films" / name).mkdir(parents=True)
    monkeypatch.setenv("FILMS", str(tmp_path / "films"))
    found = read(tmp_path, inputs=[{"path": "$FILMS/[ab]", "name": "film {}"}]).inputs
    assert [entry.name for entry in found] == ["film a", "film b"]
    assert found[0].location == str(tmp_path / "films" / "a")


def test_lists_of_values_stand_for_all_combinations(tmp_path: Path) -> None:
    items = [{"start": [0, 3], "noise": [1, 2.5]}, {"reversal": True, "overlay": 0.1}, {"start": 0}]
    plan = read(tmp_path, perturbations=items)
    assert [perturbation.title for perturbation in plan.perturbations] == [
        "noise 1", "noise 2.5", "start 3, noise 1", "start 3, noise 2.5", "reversal, overlay 10%",
        "none",
    ]  # fmt: skip


def test_grids_change_the_base(tmp_path: Path) -> None:
    base = {"extractor.num_features": 500, "extractor.num_levels": 6}
    grids = [
        {"extractor.num_features": [800, 1000], "extractor.grid": [True, False]},
        {"tracker.min_inliers": [20]},
    ]
    found = read(tmp_path, options={"base": base, "grid": grids}).options
    assert [options.label for options in found] == [
        "extractor.num_features=800, extractor.grid=true",
        "extractor.num_features=800, extractor.grid=false",
        "extractor.num_features=1000, extractor.grid=true",
        "extractor.num_features=1000, extractor.grid=false",
        "tracker.min_inliers=20",
    ]
    assert found[1].effective["extractor"]["num_features"] == 800
    assert found[1].effective["extractor"]["grid"] is False
    assert found[4].effective["extractor"]["num_features"] == 500
    assert all(options.effective["extractor"]["num_levels"] == 6 for options in found)


def test_options_start_from_a_file(tmp_path: Path) -> None:
    (tmp_path / "fast.yaml").write_text("extractor:\n  num_features: 600\n  num_levels: 4\n")
    options = {"config": "fast.yaml", "base": {"extractor.num_levels": 5}}
    effective = read(tmp_path, options=options).options[0].effective
    assert effective["extractor"]["num_features"] == 600
    assert effective["extractor"]["num_levels"] == 5


def keys(plan: Plan, content: str = "0", build: str = "1") -> list[str]:
    contents = {entry.name: content for entry in plan.inputs}
    return [task.key for task in make_tasks(plan, contents, build)]


def test_the_key_of_a_run_changes_with_whatever_changes_its_outcome(tmp_path: Path) -> None:
    plan = read(tmp_path)
    entry = plan.inputs[0]
    other = read(tmp_path, options={"base": {"extractor.num_features": 500}}).options
    changed = [
        keys(plan, content="1"),
        keys(plan, build="2"),
        keys(replace(plan, options=other)),
        keys(replace(plan, perturbations=[Perturbation(start=1)])),
        keys(replace(plan, inputs=[replace(entry, options={"fov": "60"})])),
        keys(replace(plan, inputs=[replace(entry, count=10)])),
        keys(replace(plan, inputs=[replace(entry, max_dt_s=0.1)])),
    ]
    assert len({key for run in [keys(plan), *changed] for key in run}) == 8


def test_the_key_of_a_run_does_not_depend_on_names_places_limits_and_metrics(
    tmp_path: Path,
) -> None:
    plan = read(tmp_path)
    entry = plan.inputs[0]
    moved = replace(entry, name="other", location="/elsewhere/film.mp4")
    (tmp_path / "camera.yaml").touch()
    (tmp_path / "other.yaml").touch()
    cameras = [
        replace(entry, options={"camera": str(tmp_path / name)})
        for name in ("camera.yaml", "other.yaml")
    ]
    defaults = [OptionSet("a label", plan.options[0].effective)]
    assert keys(plan) == keys(replace(plan, inputs=[moved]))
    assert keys(plan) == keys(replace(plan, options=defaults))
    assert keys(plan) == keys(replace(plan, limits=Limits(1, 1, 1), metrics={"rpe": 0.1}))
    assert keys(replace(plan, inputs=cameras[:1])) == keys(replace(plan, inputs=cameras[1:]))


def test_a_default_that_is_stated_is_no_change(tmp_path: Path) -> None:
    default = read(tmp_path).options[0].effective["tracker"]["min_inliers"]
    stated = read(tmp_path, options={"base": {"tracker.min_inliers": default}})
    assert keys(read(tmp_path)) == keys(stated)


@pytest.fixture
def images(tmp_path: Path) -> Input:
    """Two files that stand for images, a mask and a ground truth."""
    (tmp_path / "images").mkdir()
    for name in ("images/a.png", "images/b.png", "mask.png", "truth.tum"):
        (tmp_path / name).write_text(name)
    options = {"mask": str(tmp_path / "mask.png"), "gt": str(tmp_path / "truth.tum")}
    return Input("images", str(tmp_path / "images"), options)


def hash_of(entry: Input, tmp_path: Path) -> str:
    return ContentHashes(tmp_path / "hashes.json").of([entry])["images"]


def test_the_hash_of_an_input_changes_with_each_of_its_files(
    images: Input, tmp_path: Path
) -> None:
    hashes = [hash_of(images, tmp_path)]
    for name in ("images/b.png", "mask.png", "truth.tum"):
        (tmp_path / name).write_text("changed")
        hashes.append(hash_of(images, tmp_path))
    (tmp_path / "images" / "c.png").touch()
    hashes.append(hash_of(images, tmp_path))
    (tmp_path / "images" / "c.png").rename(tmp_path / "images" / "d.png")
    hashes.append(hash_of(images, tmp_path))
    assert len(set(hashes)) == 6


def test_the_hash_of_an_input_does_not_depend_on_its_place(images: Input, tmp_path: Path) -> None:
    before = hash_of(images, tmp_path)
    (tmp_path / "images").rename(tmp_path / "moved")
    assert hash_of(replace(images, location=str(tmp_path / "moved")), tmp_path) == before


def test_a_file_is_read_again_only_if_its_size_or_time_changes(
    images: Input, tmp_path: Path
) -> None:
    before = hash_of(images, tmp_path)
    file = tmp_path / "images" / "a.png"
    stat = file.stat()
    file.write_text("IMAGES/a.png")  # Of the same size.
    os.utime(file, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    assert hash_of(images, tmp_path) == before
    os.utime(file, ns=(stat.st_atime_ns, stat.st_mtime_ns + 1))
    assert hash_of(images, tmp_path) != before


def test_the_truth_beside_a_folder_counts(tmp_path: Path, data: Path) -> None:
    sequence = tmp_path / "sequences" / "06"
    sequence.mkdir(parents=True)
    for name in ("calib.txt", "times.txt", "image_0"):
        (sequence / name).symlink_to(data / "kitti" / "sequences" / "06" / name)
    (tmp_path / "poses").mkdir()
    truth = tmp_path / "poses" / "06.txt"
    truth.write_bytes((data / "kitti" / "poses" / "06.txt").read_bytes())
    entry = Input("images", str(sequence))
    before = hash_of(entry, tmp_path)
    truth.write_bytes(truth.read_bytes().replace(b"e-01", b"e-02"))
    assert hash_of(entry, tmp_path) != before


@pytest.mark.parametrize("package", PACKAGES)
def test_a_missing_package_is_named(package: str) -> None:
    code = (
        f"import sys\nsys.modules[{package!r}] = None\nfrom corvo.__main__ import main\n"
        "sys.argv = ['corvo', 'sweep', 'plan.yaml', '-o', 'sweep']\nsys.exit(main())"
    )
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert process.returncode == 1
    assert process.stderr == f"corvo: error: {package} is not installed: pip install corvo[sweep]\n"


def test_the_plan_of_the_documentation_is_one(tmp_path: Path) -> None:
    text = (REPOSITORY / "docs" / "sweep.md").read_text()
    example = yaml.safe_load(text.partition("```yaml\n")[2].partition("```")[0])
    inputs = example.pop("inputs")
    plan = read(tmp_path, **example)
    assert (len(plan.options), len(plan.perturbations)) == (4, 5)
    documented = text.partition("| inputs |")[2].partition("\n\n")[0]
    assert all(f"`{key}`" in documented for entry in inputs for key in entry)


def test_every_perturbation_and_column_is_documented() -> None:
    text = (REPOSITORY / "docs" / "sweep.md").read_text()
    perturbations = text.partition("| perturbations |")[2].partition("\n\n")[0]
    assert re.findall(r"^\| `(\w+)`", perturbations, re.M) == [f.name for f in fields(Perturbation)]
    columns = text.partition("| column |")[2].partition("\n\n")[0]
    first_cells = re.findall(r"^\| (`.*?) \|", columns, re.M)
    documented = {name for cell in first_cells for name in re.findall(r"`(\w+)`", cell)}
    assert documented == set(ROW_SCHEMA.names)


def test_the_plan_of_the_benchmark_has_its_runs(
    data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CORVO_DATA", str(data))
    plan = read_plan(REPOSITORY / "bench" / "odometry.yaml")
    tasks = list(make_tasks(plan, {entry.name: entry.name for entry in plan.inputs}, "1"))
    assert len(tasks) == 100
    assert sum(not task.is_judged for task in tasks) == 4


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    (tmp_path / "source" / "images").mkdir(parents=True)
    for name in ("a.png", "b.png"):
        (tmp_path / "source" / "images" / name).write_text(name)
    file = shutil.make_archive(str(tmp_path / "archive"), "zip", tmp_path / "source")
    return Path(file)


def test_an_input_behind_a_url_is_copied_once(archive: Path, tmp_path: Path) -> None:
    url = f"zip://images::file://{archive}"
    entry = read(tmp_path, inputs=[{"path": url, "name": "images"}]).inputs[0]
    before = hash_of(entry, tmp_path)
    copy = fetch(url)
    assert sorted(file.name for file in copy.iterdir()) == ["a.png", "b.png"]
    inode = copy.stat().st_ino
    assert fetch(url) == copy and copy.stat().st_ino == inode
    (tmp_path / "source" / "images" / "b.png").write_text("changed")
    shutil.make_archive(str(tmp_path / "archive"), "zip", tmp_path / "source")
    assert hash_of(entry, tmp_path) != before
    assert (fetch(url) / "b.png").read_text() == "changed"


def test_a_pattern_in_a_url_names_inputs(archive: Path, tmp_path: Path) -> None:
    inputs = read(tmp_path, inputs=[{"path": f"file://{tmp_path}/source/images/*.png"}]).inputs
    assert [entry.name for entry in inputs] == ["images/a.png", "images/b.png"]
    assert fetch(inputs[0].location).read_text() == "a.png"


def test_an_input_comes_from_a_server(images: Input, tmp_path: Path) -> None:
    handler = partial(SimpleHTTPRequestHandler, directory=str(tmp_path))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        url = f"http://127.0.0.1:{server.server_port}/images/b.png"
        entry = read(tmp_path, inputs=[{"path": url, "name": "images"}]).inputs[0]
        before = hash_of(entry, tmp_path)
        assert fetch(url).read_text() == "images/b.png"
        (tmp_path / "images" / "b.png").write_text("of another size")
        assert hash_of(entry, tmp_path) != before
        assert fetch(url).read_text() == "of another size"
        server.shutdown()


@pytest.mark.parametrize("url", ["https://127.0.0.1:1/film.mp4", "nothing://film.mp4"])
def test_a_url_that_cannot_be_read_is_an_error(url: str, tmp_path: Path) -> None:
    entry = read(tmp_path, inputs=[{"path": url, "name": "images"}]).inputs[0]
    with pytest.raises(corvo.Error, match=url):
        hash_of(entry, tmp_path)
