"""Readings and labelled axes, from the case file to the report."""

import pytest

from bedcheck_fixtures import CASES, bench  # noqa: F401
from conftest import BIN

READINGS = """
model: fake
readings:
  plain: {title: As told, because: it says so, parameters: {value: 0.0213}}
  raised: {title: Half as much again, because: it says so, parameters: {value: 0.032, mode: good}}
"""

OLD = """parameters: {value: 0.0213, noise: 2.1e-5, mode: good}
sweep: {height_l: [3.7, 5.1]}"""

NEW = """parameters: {noise: 2.1e-5}
sweep:
  reading: [plain, raised]
  box: {low box: {height_l: 3.7}, high box: {height_l: 5.1, noise: 2.2e-5}}"""


def make(bench, *replacements):  # noqa: F811
    """The steady case with readings and labels, its check of the value by reading."""
    text = (CASES / "fake" / "steady.yaml").read_text(encoding="utf-8")
    for old, new in (
        (OLD, NEW),
        ("expect: 0.0213", "expect: {by: reading, values: {plain: 0.0213, raised: 0.032}}"),
        ("expect: 0.031", "points: {reading: plain, box: low box}\n    expect: 0.031"),
        ("smoke: {}", "smoke: {sweep: {box: [low box, high box]}}"),
        ("{seeds: {count: 6}}", "{sweep: {box: [high box]}, parameters: {reading: raised}, "
         "checks: {not another value: off}}"),
    ) + replacements:
        assert old in text
        text = text.replace(old, new)
    bench.own_case("fake/steady", text)
    folder = bench.cases / "readings"
    folder.mkdir(exist_ok=True)
    (folder / "fake.yaml").write_text(READINGS, encoding="utf-8")


def test_points_are_named_by_reading_and_label(bench):  # noqa: F811
    make(bench)
    assert bench.run("fake/steady").returncode == 0
    verdicts = bench.verdicts()
    assert ("fake/steady", "reading=raised,box=high box", "overlap") in verdicts
    assert ("fake/steady", "reading=plain,box=low box", "not another value") in verdicts
    assert set(verdicts.values()) == {"pass"}
    page = (bench.out / "report" / "index.html").read_text(encoding="utf-8")
    assert "reading=raised,box=high box" in page


def test_run_files_tell_where_a_parameter_comes_from(bench):  # noqa: F811
    make(bench)
    bench.run("fake/steady")
    texts = [p.read_text(encoding="utf-8") for p in sorted((bench.out / "runs").glob("*.yaml"))]
    assert len(texts) == 4
    raised = [t for t in texts if 'point: "reading=raised,box=high box"' in t]
    assert len(raised) == 1
    assert "value: 0.032    # " in raised[0] and "readings/fake.yaml:5, reading raised" in raised[0]
    assert "  noise: 2.2e-5" in raised[0] and "2.1e-5" not in raised[0]
    assert "  reading:" not in raised[0] and "  box:" not in raised[0]


def test_a_fixed_reading_is_named_all_the_same(bench):  # noqa: F811
    make(bench)
    assert bench.run("fake/steady", "--tier", "paper").returncode == 0
    assert {key[1] for key in bench.verdicts()} == {"reading=raised,box=high box"}


def test_a_changed_reading_runs_its_own_points_again(bench):  # noqa: F811
    make(bench)
    bench.run("fake/steady")
    assert len(bench.calls()) == 16
    path = bench.cases / "readings" / "fake.yaml"
    path.write_text(READINGS.replace("model: fake", "# moved\nmodel: fake"), encoding="utf-8")
    bench.run("fake/steady")
    assert bench.calls() == []
    path.write_text(READINGS.replace("value: 0.032", "value: 0.0321"), encoding="utf-8")
    bench.run("fake/steady")
    assert len(bench.calls()) == 8


def test_list_and_show_know_readings_and_are_not_misled(bench):  # noqa: F811
    make(bench)
    listed = bench.bedcheck("list", "--cases", bench.cases)
    assert listed.returncode == 0 and "readings" not in listed.stdout
    shown = bench.bedcheck("show", "fake/steady", "--cases", bench.cases, "--tier", "smoke").stdout
    assert "reading: swept over [plain, raised]\n        plain: value 0.0213\n" in shown
    assert "box: swept over [low box, high box]\n        low box: height_l 3.7\n" in shown
    assert "high box: height_l 5.1, noise 2.2e-5\n" in shown
    dry = bench.run("fake/steady", "--dry-run").stdout
    assert "[reading=plain,box=low box]" in dry


@pytest.mark.parametrize("old, new, says", [
    ("[plain, raised]", "[plain, rased]", "rased: no such reading; did you mean raised?"),
    ("[low box, high box]", "[low box, hihg box]", "hihg box: no such label of this axis"),
    ("box: low box", "box: low bix", "applies to no point of tier smoke"),
    ("{height_l: 3.7}", "3.7", "low box: a label is a map of parameters"),
])
def test_what_is_not_there_is_refused(bench, old, new, says):  # noqa: F811
    make(bench, (old, new))
    done = bench.run("fake/steady", "--dry-run")
    assert done.returncode == 2 and says in done.stderr


BED = """name: suspension/bed
title: t
source: s
question: q
model: suspension
parameters: {reading: odd, particles: 50}
samples: [0]
seeds: {first: 1}
expect_s: 5
observables: {power: {recipe: sphere-power}}
checks: [{name: c, observable: power.OUTPUT, expect: 1, margin: 1, kind: model, because: b}]
tiers: {smoke: {}}
"""


def test_a_parameter_that_the_model_has_not_is_refused_by_the_solver(bench):  # noqa: F811
    recipes = bench.bedcheck("recipes").stdout.splitlines()
    at = next(i for i, line in enumerate(recipes) if line.startswith("sphere-power:"))
    bench.own_case("suspension/bed", BED.replace("OUTPUT", recipes[at + 1].split()[1]))
    (bench.cases / "readings").mkdir()
    (bench.cases / "readings" / "suspension.yaml").write_text(
        "model: suspension\nreadings: {odd: {title: t, because: b, parameters: {drive_scal: 2}}}\n",
        encoding="utf-8")
    bench.solver = BIN / "bedsim"
    done = bench.run("suspension/bed")
    assert done.returncode == 2
    assert "drive_scal" in done.stderr and "did you mean 'drive_scale'?" in done.stderr


def test_a_broken_file_of_readings_is_told_by_list_and_stops_nobody_else(bench):  # noqa: F811
    make(bench)
    path = bench.cases / "readings" / "other.yaml"
    path.write_text("model: other\nreadings: {a: {title: t, parameters: {}}}\n", encoding="utf-8")
    listed = bench.bedcheck("list", "--cases", bench.cases)
    assert listed.returncode == 2 and "other.yaml:2:15" in listed.stderr
    assert "because: missing" in listed.stderr
    assert bench.run("fake/steady", "--dry-run").returncode == 0
