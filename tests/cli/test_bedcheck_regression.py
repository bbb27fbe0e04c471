"""Regression checks, known disagreements and the budget, as a user meets them; and what went wrong
in other suites and cannot here."""

import json

import pytest

from bedcheck_fixtures import bench  # noqa: F401

CASE = """\
name: fake/change
title: t
source: s
question: q
model: fake
parameters: {noise: 0.0004}
sweep: {value: [0.02, 0.03]}
samples: [0, 1]
expect_s: 1
seeds: {first: 21, count: 3}
observables: {bed: {recipe: contacts}}
checks:
  - {name: same, observable: bed.largest_overlap, kind: regression, detects: 15 %, because: b}
tiers: {smoke: {}, paper: {}}
"""

HEADER = "tier point observable origin value deviation seeds meaning commit solver_key date reason"


def line(row, origin="ensemble", value=0.02, deviation=0.0004, seeds=32, tier="smoke"):
    point = "-" if row["point"] == "single" else row["point"]
    made = (row["meaning"], "01" * 20, "ab" * 32) if origin in ("ensemble", "seed") else "---"
    return "\t".join(map(str, (tier, point, row["key"], origin, value, deviation, seeds, *made,
                               "2026-11-22", "a test")))


def store(bench, *lines):
    path = bench.folder / "references" / "fake" / "change.tsv"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join((HEADER.replace(" ", "\t"), *sorted(lines))) + "\n", encoding="utf-8")


def run(bench, *words, out="out"):
    bench.out = bench.folder / out
    return bench.run("fake/change", "--references", bench.folder / "references", *words)


def rows(bench):
    return bench.results()["checks"]


@pytest.fixture
def changed(bench):  # noqa: F811
    """The case with a reference for each of its two points."""
    bench.own_case("fake/change", CASE)
    assert run(bench, out="first").returncode == 3
    store(bench, *(line(row, value=0.01 * (2 + i)) for i, row in enumerate(rows(bench))))
    return bench


def test_without_a_reference_nothing_passes_and_none_is_made(bench):  # noqa: F811
    bench.own_case("fake/change", CASE)
    done = run(bench)
    assert done.returncode == 3
    assert {row["verdict"] for row in rows(bench)} == {"inconclusive"}
    assert "no ensemble reference" in done.stdout
    assert not (bench.folder / "references").exists()


def test_unchanged_code_passes_and_the_budget_is_told(changed):
    done = run(changed)
    assert done.returncode == 0, done.stdout
    results = changed.results()
    assert results["budget"] == {"allowed": 1e-3, "share": 5e-4, "statistical": 2, "judged": 2,
                                 "unknown": 0, "computed": 1e-3}
    for row in results["checks"]:
        assert row["statistical"] and row["alarm_rate"] == 5e-4
        assert row["tolerance"] < row["detectable"] < 0.15 * row["expected"]
        assert len(row["values"]) == len(row["seeds"]) == 3
    for file in ("summary.md", "report/index.html"):
        assert "each of its 2 statistical checks" in (changed.out / file).read_text(encoding="utf-8")


@pytest.mark.parametrize("sign", [1, -1])
def test_a_changed_solver_fails_whichever_way_it_changed(changed, sign):
    """Planted in the solver's program: every value off by 15 % of the smaller one."""
    text = changed.solver.read_text(encoding="utf-8")
    changed.solver.write_text(text.replace('"$@"', f'"$@" --set slope={sign * 0.003} --set width_l=1'),
                              encoding="utf-8")
    assert run(changed).returncode == 1
    assert rows(changed)[0]["verdict"] == "fail"
    assert not changed.results()["modified"]


def test_seeds_that_scatter_more_fail_though_their_mean_stays(changed):
    text = changed.solver.read_text(encoding="utf-8")
    changed.solver.write_text(text.replace('"$@"', '"$@" --set noise=0.04'), encoding="utf-8")
    assert run(changed).returncode == 1


@pytest.mark.parametrize("old, new", [
    ("smoke\t", "paper\t"),                      # another tier's
    ("bed.largest_overlap", "bed.largest_overlp"),
    ("value=0.02", "value=0.021"),
    ("ensemble", "independent"),
])
def test_a_mistyped_or_foreign_reference_judges_nothing_and_is_refused(changed, old, new):
    path = changed.folder / "references" / "fake" / "change.tsv"
    text = path.read_text(encoding="utf-8")
    lines = [l.replace(old, new) for l in text.splitlines()[1:]]
    if new == "independent":
        lines = ["\t".join(("-" if 7 <= i <= 9 else word) for i, word in enumerate(l.split("\t")))
                 for l in lines]
    store(changed, *lines)
    done = run(changed)
    if old == "smoke\t":  # the case has a paper tier: there the line is of use
        assert done.returncode == 3
        assert "inconclusive" in {row["verdict"] for row in rows(changed)}
        return
    listed = changed.bedcheck("list", "--cases", changed.cases, "--references",
                              changed.folder / "references")
    for refused in (done, listed):
        assert refused.returncode == 2 and "change.tsv:2:" in refused.stderr


def test_another_case_text_makes_the_reference_another(changed):
    changed.own_case("fake/change", CASE.replace("samples: [0, 1]", "samples: [0, 1.5]"))
    done = run(changed)
    assert done.returncode == 3
    assert "another text of the case" in done.stdout


def test_a_check_that_cannot_see_what_it_says_is_refused_before_any_run(changed):
    changed.own_case("fake/change", CASE.replace("detects: 15 %", "detects: 3 %"))
    changed.calls()
    done = run(changed, out="refused")
    assert done.returncode == 2 and changed.calls() == []
    assert "change.yaml:13:" in done.stderr and "says that it detects 3 %" in done.stderr
    listed = changed.bedcheck("list", "--cases", changed.cases, "--references",
                              changed.folder / "references")
    assert listed.returncode == 2 and "says that it detects 3 %" in listed.stderr


KNOWN = """\
  - {name: paper, observable: bed.largest_overlap, kind: model, expect: 0.05, margin: 10 %,
     scatter: 0.0004, because: b, known: {because: other spheres, since: 2026-11-20}}
"""


def test_a_known_disagreement_is_shown_counted_and_decides_nothing(changed):
    changed.own_case("fake/change", CASE.replace("tiers:", KNOWN + "tiers:"))
    done = run(changed)
    assert done.returncode == 0, done.stdout + done.stderr
    assert changed.results()["counts"]["known"] == 2
    assert "2 known" in done.stdout
    changed.own_case("fake/change", CASE.replace("tiers:", KNOWN.replace("0.05", "0.02") + "tiers:"))
    assert run(changed).returncode == 1  # at value 0.02 it agrees now
    assert any("agrees now" in row["reason"] for row in rows(changed) if row["verdict"] == "fail")


def test_an_exit_code_is_no_number_of_failures(bench):  # noqa: F811
    """256 failures would be exit code 0."""
    checks = "".join(
        f"  - {{name: off {i}, observable: bed.largest_overlap, kind: model, expect: 1, margin: 3 %,\n"
        "     scatter: 0, because: b}\n" for i in range(256))
    text = CASE.replace("[0.02, 0.03]", "[0.02]").replace("count: 3", "count: 1")
    text = text[:text.index("  - {name")] + checks + text[text.index("tiers:"):]
    bench.own_case("fake/change", text)
    done = run(bench)
    assert done.returncode == 1
    assert bench.results()["counts"]["fail"] == 256


def test_every_row_that_is_not_a_pass_counts(changed):
    """No warning that leaves the whole green: verdict, counts and exit code say the same."""
    text = changed.solver.read_text(encoding="utf-8")
    changed.solver.write_text(text.replace('"$@"', '"$@" --set slope=0.003 --set width_l=1'),
                              encoding="utf-8")
    done = run(changed)
    results = json.loads((changed.out / "results.json").read_text(encoding="utf-8"))
    said = [row["verdict"] for row in results["checks"]]
    assert {word: said.count(word) for word in ("pass", "fail", "inconclusive", "known")} == {
        word: results["counts"][word] for word in ("pass", "fail", "inconclusive", "known")}
    assert results["verdict"] == "fail" and done.returncode == 1
