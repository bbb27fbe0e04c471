"""bedcheck calibrate: many seeds, alarm rates, margins, and seeds held out."""

import os
import re

from bedcheck_fixtures import bench  # noqa: F401
from conftest import BIN, call

CASE = """
name: fake/steady
title: A quantity with scatter
source: none, a test
question: Does the fake solver give the value that it was told to give?
model: fake
parameters: {value: 0.0213, noise: 2.1e-5, mode: good}
samples: [0, 1.37]
seeds: {first: 1101, count: 2}
expect_s: 3
limit_s: 60
observables: {bed: {recipe: contacts}}
checks:
  - name: wide
    observable: bed.largest_overlap
    expect: 0.0213
    scatter: 0.1 %
    margin: 2 %
    kind: model
    because: the value is a parameter
  - name: narrow
    observable: bed.largest_overlap
    expect: 0.0213
    scatter: 0.1 %
    margin: 0.15 %
    kind: model
    because: too narrow for two seeds, whose mean scatters by 0.07 %
  - name: unchanged
    observable: bed.largest_overlap
    kind: regression
    detects: 10 %
    because: the scatter is 0.1 %
tiers: {smoke: {}}
"""


def calibrate(bench, *words, **options):
    environment = dict(os.environ, FAKE_LOG=str(bench.log))
    return call(BIN / "bedcheck", "calibrate", *words, "--cases", bench.cases, "--out", bench.out,
                "--solver", bench.solver, env=environment, **options)


def test_rates_margins_and_seeds_held_out(bench):
    bench.own_case("fake/steady", CASE)
    done = calibrate(bench, "fake/steady", "--seeds", 12)
    assert done.returncode == 0, done.stderr
    assert sorted(bench.calls())[-1].endswith("-s1112.h5")
    assert "12 seeds a point; budget 0.001 false alarms a run of the suite, 3 rows share it: 0.00033" \
        in done.stdout
    rates = [float(x) for x in re.findall(r"alarm rate ([0-9.e+-]+)", done.stdout)]
    assert len(rates) == 2 and rates[0] < 1e-3 < 0.05 < rates[1]
    assert done.stdout.count("over its share") >= 1
    proposed = [float(x) for x in re.findall(r"would do: .*margin ([0-9.e+-]+)", done.stdout)]
    # both rows ask the same: five or so deviations of the mean of two seeds, and h
    assert proposed[0] == proposed[1] and 4e-5 < proposed[0] < 4e-4
    held = re.findall(r"held out: (\d+) runs of (\d+) seeds, (\d+) do not pass", done.stdout)
    assert [x[:2] for x in held] == [("3", "2")] * 3 and int(held[0][2]) == 0
    assert "held-out runs of all rows: 9" in done.stdout
    # again: nothing is run, the same is said
    again = calibrate(bench, "fake/steady", "--seeds", 12)
    assert bench.calls() == [] and again.stdout.splitlines()[-12:] == done.stdout.splitlines()[-12:]


def test_a_failed_run_leaves_rows_without_a_rate(bench):
    bench.own_case("fake/steady", CASE.replace("mode: good", "mode: nan"))
    done = calibrate(bench, "fake/steady", "--seeds", 4)
    assert done.returncode == 0 and "3 rows without an ensemble" in done.stdout
    assert "no ensemble: the result cannot be used" in done.stdout


def test_what_calibrate_refuses(bench):
    bench.own_case("fake/steady", CASE)
    for words in (["fake/steady"], ["fake/steady", "--seeds", 3], ["--seeds", 12],
                  ["fake/none", "--seeds", 12], ["fake/steady", "--seeds", "x"],
                  ["fake/steady", "--seeds", 12, "--set", "value=1"]):
        done = calibrate(bench, *words)
        assert done.returncode == 2 and done.stderr, words
    assert "--seeds K, 4 or more" in calibrate(bench, "fake/steady").stderr
    assert bench.calls() == []


def test_a_dry_run_runs_nothing(bench):
    bench.own_case("fake/steady", CASE)
    done = calibrate(bench, "fake/steady", "--seeds", 12, "--dry-run")
    assert done.returncode == 0 and "12 runs: 0 reused, 12 to make" in done.stdout
    assert bench.calls() == [] and not bench.out.exists()


def test_run_with_more_seeds_is_remembered_by_its_folder(bench):
    bench.own_case("fake/steady", CASE)
    bench.run("--seeds", 3)
    assert len(bench.calls()) == 3
    done = bench.bedcheck("check", bench.out)
    assert done.returncode in (0, 1, 3) and bench.results()["checks"][0]["runs"][-1].endswith("-s1103")
