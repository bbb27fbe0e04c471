"""A fake solver, its cases and short ways to call bedcheck on them."""

import json
import os
import pathlib
import stat
import sys

import pytest

from conftest import BIN, ROOT, call

CASES = ROOT / "tests" / "cases"
FAKE = ROOT / "tests" / "cli" / "fake_solver.py"


class Bench:
    """One folder of results, one solver, one folder of cases."""

    def __init__(self, folder):
        self.folder = folder
        self.out = folder / "out"
        self.cases = CASES
        self.log = folder / "calls.log"
        self.solver = folder / "solver"
        self.build_solver("first build")

    def build_solver(self, mark):
        """(Re)build the solver program: `mark` changes its bytes."""
        self.solver.write_text(
            f'#!/bin/sh\n# {mark}\nexec "{sys.executable}" "{FAKE}" "$@"\n', encoding="utf-8"
        )
        self.solver.chmod(self.solver.stat().st_mode | stat.S_IXUSR)

    def run(self, *words, **options):
        """bedcheck run WORDS with the fake solver."""
        environment = dict(os.environ, FAKE_LOG=str(self.log))
        return call(BIN / "bedcheck", "run", *words, "--cases", self.cases, "--out", self.out,
                    "--solver", self.solver, env=environment, **options)

    def bedcheck(self, *words, **options):
        return call(BIN / "bedcheck", *words, **options)

    def calls(self):
        """Names of the runs that the solver was asked for since the last time."""
        if not self.log.exists():
            return []
        names = self.log.read_text(encoding="utf-8").split()
        self.log.unlink()
        return names

    def results(self):
        return json.loads((self.out / "results.json").read_text(encoding="utf-8"))

    def verdicts(self):
        """{(case, point, check): verdict} of the last report."""
        return {(c["case"], c["point"], c["check"]): c["verdict"] for c in self.results()["checks"]}

    def own_case(self, name, text):
        """A folder of cases with this one alone."""
        self.cases = self.folder / "cases"
        path = self.cases / f"{name}.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def spoil(self, name, old, new):
        """A copy of one of our cases with a text replaced."""
        text = (CASES / f"{name}.yaml").read_text(encoding="utf-8")
        assert old in text
        self.own_case(name, text.replace(old, new))


@pytest.fixture
def bench(tmp_path):
    return Bench(tmp_path)
