"""Negative controls: what breaks the physics turns the smoke tier red.

A check that has never failed is not a check.  Here the solver is given wrong
physics behind the judge's back (--set), or is built with one constant changed.
"""

import json
import shutil
import subprocess

import pytest

from conftest import ROOT


def rows(folder, verdict):
    results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
    return results, {row["case"] for row in results["checks"] if row["verdict"] == verdict}


VERIFICATION = ("graingas/verification-*",)
BEDS = ("graingas/minimum-fluidization*", "graingas/fluidization*", "graingas/bubbles*")


@pytest.mark.parametrize(
    "cases, setting, red",
    [
        (VERIFICATION, "restitution=0.5", {"graingas/verification-collision"}),
        # four times the standard
        (VERIFICATION, "dt_tau=0.05", {"graingas/verification-relaxation-time"}),
        (VERIFICATION, "darcy=corrected", {"graingas/verification-darcy-column"}),
        (BEDS, "darcy=corrected", {"graingas/minimum-fluidization", "graingas/fluidization",
                                   "graingas/fluidization-fig5"}),
        (BEDS, "face=harmonic", {"graingas/bubbles"}),
        # everything slow counts as ground, the rising plug too
        (BEDS, "sleep_displacement_l=0.1", {"graingas/minimum-fluidization-corrected"}),
    ],
)
def test_wrong_physics_turns_the_smoke_tier_red(bedcheck, tmp_path, cases, setting, red):
    done = bedcheck("run", *cases, "--tier", "smoke", "--jobs", "2", "--out", tmp_path / "out",
                    "--set", setting, timeout=600)
    assert done.returncode == 1, done.stdout + done.stderr
    results, failed = rows(tmp_path / "out", "fail")
    assert red <= failed
    assert results["modified"] and setting in json.dumps(results)
    assert "MODIFIED" in (tmp_path / "out" / "summary.md").read_text(encoding="utf-8")
    assert "MODIFIED" in (tmp_path / "out" / "report" / "index.html").read_text(encoding="utf-8")


def build_solver(source, build):
    """bedsim of a source tree; only a missing compiler can make this fail."""
    subprocess.run(["cmake", "-S", source, "-B", build, "-G", "Ninja", "-DBUILD_TESTING=OFF"],
                   check=True, capture_output=True)
    subprocess.run(["cmake", "--build", build, "--target", "bedsim"], check=True,
                   capture_output=True)
    return build / "bin" / "bedsim"


def test_one_changed_constant_changes_the_verdict(bedcheck, tmp_path):
    source, out = tmp_path / "source", tmp_path / "out"
    shutil.copytree(ROOT, source, ignore=shutil.ignore_patterns(".git", "build", "bedcheck-out"))
    command = ["run", "graingas/verification-darcy-column", "graingas/verification-settling-law",
               "--tier", "smoke", "--out", out, "--solver"]
    solver = build_solver(source, tmp_path / "build")
    assert bedcheck(*command, solver).returncode == 0
    darcy = source / "solver" / "graingas" / "darcy.h"
    text = darcy.read_text(encoding="utf-8")
    assert text.count("kappa = phi * phi * phi / (rho * rho)") == 1
    darcy.write_text(text.replace("kappa = phi * phi * phi / (rho * rho)",
                                  "kappa = 1.01 * phi * phi * phi / (rho * rho)"),
                     encoding="utf-8")
    build_solver(source, tmp_path / "build")
    done = bedcheck(*command, solver)
    assert done.returncode == 1, done.stdout + done.stderr
    _, failed = rows(out, "fail")
    assert failed == {"graingas/verification-darcy-column", "graingas/verification-settling-law"}
