"""A third party's solver is judged through the contract alone: docs/examples."""

import json
import re
import stat
import sys

import h5py
import numpy as np
import pytest

from conftest import BIN, ROOT, call

EXAMPLES = ROOT / "docs" / "examples"
CASE = "suspension/compaction-kinematic"
RUN = """\
format: bedcheck-run 1
case: test/wave
point: only
model: suspension
samples: {from: 0, to: 0.9, every: 0.1}
datasets: [profiles/packing_fraction]
parameters:
  particles: 2137
  width_x_R: 13.7
  width_y_R: 11.3
  height_R: 220
  radius_m: 5.7e-4
  start: sharp
  phibar: 0.31
  phibar_times_s: [0]
  phibar_values: [0.52]
  drive: linear
  drag_per_s: 4.7
"""


@pytest.fixture
def solver(tmp_path):
    """solver(NAME): a program that runs this example with the Python of these tests."""

    def make(name):
        path = tmp_path / name
        path.write_text(f'#!/bin/sh\nexec "{sys.executable}" -B "{EXAMPLES}/{name}.py" "$@"\n',
                        encoding="utf-8")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    return make


@pytest.fixture
def judge(solver, tmp_path):
    """judge(NAME, TIER) -> (exit code, {check: row of results.json})."""

    def go(name, tier):
        out = tmp_path / f"{name}-{tier}"
        done = call(BIN / "bedcheck", "run", CASE, "--tier", tier, "--out", out, "--solver",
                    solver(name), "--cases", ROOT / "validation" / "cases", "--jobs", 1)
        rows = json.loads((out / "results.json").read_text(encoding="utf-8"))["checks"]
        return done.returncode, {row["check"]: row for row in rows}

    return go


@pytest.fixture
def wave(solver, tmp_path):
    """wave(*words, text=RUN): one run of the example; wave.out is its result."""

    def go(*words, text=RUN):
        (tmp_path / "x.yaml").write_text(text, encoding="utf-8")
        go.out = tmp_path / "x.h5"
        return call(solver("kinematic_solver"), "run", tmp_path / "x.yaml", "--seed", 7, "--out",
                    go.out, "--quiet", *words)

    return go


# -- judged ----------------------------------------------------------------------------


@pytest.mark.parametrize("tier", ["smoke", "paper"])
def test_the_kinematic_wave_passes_and_is_where_the_exact_one_is(judge, tier):
    code, rows = judge("kinematic_solver", tier)
    assert code == 0, rows
    assert all(row["verdict"] == "pass" for row in rows.values())
    assert abs(rows["fronts meet"]["measured"] - 1) < 2e-3
    assert rows["centre of mass"]["measured"] < 0.05
    if tier == "paper":
        assert rows["top"]["measured"] < 0.1 and rows["bottom front"]["measured"] < 0.1


def test_the_same_with_one_mistake_fails_every_check(judge):
    code, rows = judge("kinematic_solver_wrong", "paper")
    assert code == 1
    assert {row["verdict"] for row in rows.values()} == {"fail"}, rows
    assert rows["solid is kept"]["measured"] > 0.01


def test_a_weaker_drag_behind_the_judges_back_fails(solver, tmp_path):
    done = call(BIN / "bedcheck", "run", CASE, "--tier", "paper", "--out", tmp_path / "o", "--solver",
                solver("kinematic_solver"), "--cases", ROOT / "validation" / "cases",
                "--set", "drag_per_s=4.6")
    assert done.returncode == 1, done.stdout
    assert "MODIFIED" in done.stdout + (tmp_path / "o" / "summary.md").read_text(encoding="utf-8")


# -- by itself ---------------------------------------------------------------------------


def test_the_result_keeps_the_contract(wave):
    done = wave()
    assert done.returncode == 0 and done.stdout == "" and done.stderr == ""
    load = 2137 * 4 / 3 * np.pi / (13.7 * 11.3)
    with h5py.File(wave.out) as f:
        series = f["profiles/packing_fraction"]
        assert np.allclose(series["time"], np.arange(10) / 10)
        assert series["value"].shape == (10, 220) and series["value"].attrs["unit"] == "1"
        assert np.allclose(np.sum(series["value"], axis=1), load, rtol=1e-12)
        assert np.min(series["value"]) >= 0 and np.max(series["value"]) <= 0.52 + 1e-12
        assert np.isclose(f["profiles"].attrs["spacing"], 5.7e-4)
        # where the front from the floor is: at c phi0 t, in R
        c = 4.65 * 0.6 * 9.81 / 0.48 / (4.7 * 0.48 ** -4.65) / 5.7e-4
        front = np.sum(series["value"][3] > (0.31 + 0.52) / 2)
        assert abs(front - c * 0.31 * 0.3) < 1.5
    first = wave.out.read_bytes()
    wave()
    assert wave.out.read_bytes() == first


@pytest.mark.parametrize("old, new, says", [
    ("bedcheck-run 1", "bedcheck-run 2", "format"),
    ("model: suspension", "model: graingas", "graingas"),
    ("[profiles/packing_fraction]", "[observables/collisions]", "observables/collisions"),
    ("drag_per_s", "drag_per_S", "drag_per_S"),
    ("  start: sharp\n", "", "start: missing"),
    ("start: sharp", "start: random", "start: sharp"),
    ("4.7", "-4.7", "drag_per_s"),
    ("2137", "many", "particles"),
    ("[0.52]", "[0.52, 0.4]", "one change"),
    ("height_R: 220", "height_R: 150", "the bed is"),
    ("every: 0.1", "every: 0", "every"),
])
def test_what_it_cannot_take_is_refused(wave, old, new, says):
    assert old in RUN
    done = wave(text=RUN.replace(old, new))
    assert done.returncode == 2 and says in done.stderr, done.stderr
    assert "Traceback" not in done.stderr and not wave.out.exists()


def test_set_overrides_and_is_checked(wave):
    assert wave("--set", "drag_per_s=9.4e0").returncode == 0
    with h5py.File(wave.out) as f:
        assert f["parameters"].attrs["drag_per_s"] == 9.4
    wave.out.unlink()
    assert wave("--set", "drag=3").returncode == 2


# -- the documents -------------------------------------------------------------------------


def test_the_documents_name_what_is_there():
    text = (ROOT / "docs" / "contract.md").read_text(encoding="utf-8")
    for name in ("kinematic_solver.py", "kinematic_solver_wrong.py", CASE):
        assert name in text, name
    for name in re.findall(r"docs/examples/(\w+\.py)", text):
        assert (EXAMPLES / name).exists(), name
