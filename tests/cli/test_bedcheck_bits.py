"""Bits of references from end to end, on our own solver: unchanged, other bits, another class."""

import json
import os
import re

import pytest

from conftest import BIN, call
from test_bedcheck_accept import Checkout

# Kicks and drag take exp, log and cos from the C library; a few collisions part two builds.
CASE = """
name: tiny/gas
title: Few spheres, soon chaotic
source: none, a test
question: Are the bits those of the reference?
model: suspension
parameters:
  particles: 173
  packing_fraction: 0.31
  restitution: 0.97
  guard: none
  drag_per_s: 3.7
  noise_rate: fixed-kick
  boundary_x: periodic
  boundary_y: periodic
  boundary_z: periodic
samples: {from: 0, to: 0.6, every: 0.02}
seeds: {first: 4101, count: 2}
expect_s: 1
limit_s: 60
observables: {gas: {recipe: sphere-collisions, from_s: 0.1}}
checks:
  - {name: rate, observable: gas.rate, kind: regression, detects: 9 %, because: seeds scatter by 1 %}
tiers: {smoke: {}}
"""

OTHER_LIBM = "glibc.cpu.hwcaps=-FMA,-AVX2"


class Tree(Checkout):
    """A checkout whose solver is bedsim behind a script, which can be changed."""

    def program(self, more="", environment=""):
        self.solver.write_text(f'#!/bin/sh\n{environment}exec "{BIN / "bedsim"}" "$@" {more}\n',
                               encoding="utf-8")
        self.solver.chmod(0o755)

    def measured(self, name, *words):
        """The folder NAME with runs of the present solver; the last line's verdict."""
        self.out = self.folder / name
        done = call(BIN / "bedcheck", "run", "--cases", self.cases, "--references", self.references,
                    "--solver", self.solver, "--out", self.out, *words)
        assert done.returncode in (0, 1, 3), done.stdout + done.stderr
        return done.returncode

    def bits(self):
        """What results.json says of runs, and the report beside it."""
        text = (self.out / "summary.md").read_text(encoding="utf-8")
        page = (self.out / "report/index.html").read_text(encoding="utf-8")
        return self.results()["bits"], self.results()["checks"][0]["bits"], text + page


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """The tiny case with references of 34 seeds of bedsim as it is."""
    tree = Tree(tmp_path_factory.mktemp("tree"))
    tree.references.mkdir(parents=True)
    tree.write("cases/tiny/gas.yaml", CASE)
    tree.git("init", "-q")
    tree.commit("the case")
    tree.program()
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("CI", raising=False)
        patch.delenv("GLIBC_TUNABLES", raising=False)
        tree.measured("ensemble", "--seeds", "34")
        tree.rebuild(commit=tree.head(), dirty="clean")  # the checkout is this one, not bedsim's
        done = tree.accept(choice=["--case", "tiny/gas"])
        assert done.returncode == 0, done.stderr
    return tree


@pytest.fixture(autouse=True)
def plain(monkeypatch):
    monkeypatch.delenv("CI", raising=False)
    monkeypatch.delenv("GLIBC_TUNABLES", raising=False)


def test_the_same_build_has_the_same_bits_and_they_are_unchanged(tree):
    tree.program()
    assert tree.measured("again") == 0
    whole, row, text = tree.bits()
    assert whole == {"same": 2, "other": 0, "unknown": 0} and row == "same bits as the reference"
    assert "2 of 2 runs have the bits of their references: unchanged." in text


@pytest.mark.parametrize("value, code", [("2.0000000000001e-9", 0), ("2.9e-9", 1)])
def test_other_bits_of_the_same_class_are_left_to_statistics(tree, value, code):
    """A solver that is changed, by less than scatter and by more."""
    tree.program(more=f"--set thermal_energy_J={value}")
    assert tree.measured(f"changed-{value}") == code
    whole, row, text = tree.bits()
    assert whole == {"same": 0, "other": 2, "unknown": 0}
    assert row == "other bits than the reference in 2 of 2 runs"
    assert "2 have others: there statistics decide." in text


def test_another_mathematical_library_is_another_class_and_passes(tree):
    tree.program(environment=f"GLIBC_TUNABLES={OTHER_LIBM} ")
    assert tree.measured("libm") == 0
    whole, row, text = tree.bits()
    if {json.loads(p.read_text())["build"]["libc"] for p in tree.records()} == {
            line["value"].split(":")[0].split("/")[-1] for line in tree.table("tiny/gas")}:
        pytest.skip("this processor has one mathematical library only")
    assert whole == {"same": 0, "other": 0, "unknown": 2} and row is None
    assert "No bits of this class of build are stored for the 2 runs: statistics decide." in text


def test_how_far_two_builds_agree_is_measured(tree):
    """From the last digit to the whole: the samples where runs begin to differ and where they part."""
    tree.program()
    tree.measured("one")
    tree.program(environment=f"GLIBC_TUNABLES={OTHER_LIBM} ")
    tree.measured("two")
    done = tree.bedcheck("compare", tree.folder / "one", tree.folder / "two", "--json")
    assert done.returncode in (0, 3), done.stdout  # two seeds may not resolve it
    runs = json.loads(done.stdout)["runs"]
    if all(r["bits"] == "unchanged" for r in runs):
        pytest.skip("this processor has one mathematical library only")
    for r in runs:
        assert r["bits"] == "differ" and 0 < r["first_time"] < 0.2 and r["first_size"] < 1e-13
        assert r["first_time"] < r["parted_time"] <= 0.6
    text = tree.bedcheck("compare", tree.folder / "one", tree.folder / "two").stdout
    assert re.search(r"2 of 2 runs differ: first at \S+ \(step \d+, .*\); parted at \S+ \(step ", text)


def test_runs_are_compared_with_references_by_their_bits(tree):
    tree.program()
    tree.measured("now")
    done = tree.bedcheck("compare", tree.folder / "now", "--references", tree.references)
    assert done.returncode == 0 and "2 unchanged, 0 differ" in done.stdout, done.stdout
    assert "1 checks in both: 1 unchanged" in done.stdout
    tree.program(more="--set thermal_energy_J=2.0000000000001e-9")
    tree.measured("then")
    done = tree.bedcheck("compare", tree.folder / "then", "--references", tree.references)
    assert done.returncode == 0 and "0 unchanged, 2 differ" in done.stdout, done.stdout
    assert "1 checks in both: 0 unchanged, 1 same" in done.stdout
