"""bedcheck accept and the verdicts of the papers' claims: stored, judged by, and refused."""

import json

import pytest

from test_bedcheck_accept import CASE, SECOND, Checkout, add_line, fresh_copy, lines_of

CLAIMS = """
paper: FAKE
title: A. Fake, J. Fakes 1, 1 (1999)
claims:
  - id: fake-value
    where: Section II
    says: It is .0213, and space is filled to .37.
    tests:
      - {case: fake/steady, check: overlap}
      - {case: fake/second, check: solid fraction}
    verdict: reproduced
    otherwise: not reproduced
    because: it must
  - id: fake-part
    where: Section II
    says: It is .0213 in the higher bed.
    tests: [{case: fake/steady, check: overlap, points: {height_l: 5.1}}]
    verdict: reproduced
    otherwise: not reproduced
    because: it must
  - id: fake-paper
    where: Section III
    says: It is .0213 in a long run.
    tests: [{case: fake/second, check: in a long run}]
    verdict: reproduced
    otherwise: not reproduced
    because: it must
  - id: fake-cost
    where: Section IV
    says: It is fast.
    verdict: underdetermined
    untested: no such machine
    because: nothing follows
"""

# A check of the paper tier alone, and none that needs a reference.
LONG = """  - name: in a long run
    observable: bed.solid_fraction_max
    expect: 0.37
    margin: 0.001
    kind: round-off
    tiers: [paper]
    because: .37 and a thousandth of the overlap
tiers:"""


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A checkout with claims, and results of four seeds."""
    bench = Checkout(tmp_path_factory.mktemp("made"))
    bench.create()
    bench.write("cases/fake/steady.yaml", CASE[:CASE.index("  - name: unchanged")].replace("[3.7, 5.1]", "[5.1]")
                + "tiers:\n  smoke: {}\n  paper: {}\n")
    bench.write("cases/fake/second.yaml", SECOND[:SECOND.index("  - name: pair")]
                + LONG + " {smoke: {}, paper: {}}\n")
    bench.write("claims/fake.yaml", CLAIMS)
    bench.commit("claims")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FAKE_BUILD", json.dumps({"commit": bench.head(), "dirty": "clean"}))
        bench.measure(seeds=4)
    return bench


@pytest.fixture
def bench(made, tmp_path, monkeypatch):
    return fresh_copy(made, tmp_path, monkeypatch)


def accept(bench, *words, **choices):
    return bench.accept(*words, **{"choice": ["--claims"], **choices})


def stored(bench):
    """{(claim, tier): line}"""
    return {(x["id"], x["tier"]): x for x in bench.table("claims")}


def judge(bench):
    """Exit code of judging the folder again, and {claim: verdict} of the rows of claims."""
    done = bench.bedcheck("check", bench.out, "--cases", bench.cases, "--references",
                          bench.references)
    assert done.returncode in (0, 1, 3), done.stderr
    return done.returncode, {c["check"]: c["verdict"] for c in bench.results()["checks"]
                             if c["kind"] == "claim"}


def spoil(bench):
    """The claim's check fails from now on, on the same runs, and is known to."""
    path = bench.cases / "fake/steady.yaml"
    text = path.read_text(encoding="utf-8")
    assert "expect: 0.0213" in text
    path.write_text(text.replace("expect: 0.0213", "known: {because: a fault, since: 2026-11-21}\n"
                                 "    expect: 0.0233"), encoding="utf-8")
    bench.commit("another expectation")
    bench.rebuild(commit=bench.head())


def test_verdicts_of_the_tier_are_stored_with_their_history(bench):
    done = accept(bench)
    assert done.returncode == 0, done.stderr
    assert "smoke fake-value: none -> reproduced" in done.stdout
    assert done.stdout.endswith("reference: 2 claims changed\n")
    lines = stored(bench)
    assert set(lines) == {("fake-value", "smoke"), ("fake-part", "smoke")}
    assert bench.files() == ["claims.tsv"]  # four seeds are no ensemble, and none was asked for
    one = lines["fake-value", "smoke"]
    assert one["verdict"] == "reproduced" and one["reason"] == "first set"
    assert one["commit"] == bench.head()


def test_a_verdict_that_changes_fails_the_run(bench):
    assert judge(bench) == (0, {})  # nothing is stored on the spot
    assert accept(bench).returncode == 0
    assert judge(bench) == (0, {"claim fake-value": "pass", "claim fake-part": "pass"})
    spoil(bench)
    code, rows = judge(bench)
    assert code == 1 and rows == {"claim fake-value": "fail", "claim fake-part": "fail"}


def test_a_changed_verdict_is_accepted_for_a_reason(bench):
    assert accept(bench).returncode == 0
    before = stored(bench)
    spoil(bench)
    done = accept(bench, "--dry-run", reason="the expectation was wrong")
    assert "smoke fake-part: reproduced -> not reproduced" in done.stdout and stored(bench) == before
    assert accept(bench, reason="the expectation was wrong").returncode == 0
    one = stored(bench)["fake-part", "smoke"]
    assert one["verdict"] == "not reproduced" and one["reason"] == "the expectation was wrong"
    assert judge(bench) == (0, {"claim fake-value": "pass", "claim fake-part": "pass"})


def test_verdicts_that_stay_keep_their_history(bench):
    assert accept(bench).returncode == 0
    before = stored(bench)
    done = accept(bench, reason="once more")
    assert done.returncode == 0 and "0 claims changed" in done.stdout and stored(bench) == before


def test_only_claims_all_of_whose_cases_are_chosen(bench):
    bench.measure(seeds=34)
    done = bench.accept(choice=["--case", "fake/steady"])
    assert done.returncode == 0, done.stderr
    assert set(stored(bench)) == {("fake-part", "smoke")}  # fake-value rests on fake/second too
    assert "1 of 1 cases, 1 claim changed" in done.stdout
    assert bench.files() == ["claims.tsv", "fake/steady.tsv"]
    assert "fake-value: none -> reproduced" in bench.accept().stdout


def test_only_claims_all_of_whose_cases_were_run(bench):
    bench.bedcheck("clean", bench.out)
    bench.run("fake/steady", "--references", bench.references)
    done = accept(bench)
    assert done.returncode == 0, done.stderr
    assert set(stored(bench)) == {("fake-part", "smoke")}


def test_tiers_are_kept_apart(bench):
    assert accept(bench).returncode == 0
    bench.as_tier("paper")
    done = accept(bench)
    assert "paper fake-paper: none -> reproduced" in done.stdout, done.stderr
    assert {tier for claim, tier in stored(bench) if claim == "fake-paper"} == {"paper"}
    assert len(stored(bench)) == 5


def test_what_is_not_tested_any_more_goes_and_its_row_fails_until_then(bench):
    assert accept(bench).returncode == 0
    line = next(x for x in lines_of(bench.references / "claims.tsv") if x.startswith("fake-part"))
    add_line(bench.references / "claims.tsv", line.replace("fake-part", "fake-paper"))
    code, rows = judge(bench)
    assert code == 1 and rows["claim fake-paper"] == "fail"
    done = accept(bench, reason="a test of the paper tier")
    assert "smoke fake-paper: reproduced -> none" in done.stdout
    assert set(stored(bench)) == {("fake-value", "smoke"), ("fake-part", "smoke")}


def test_an_undecided_claim_is_told_and_nothing_is_stored(bench):
    path = bench.cases / "fake/steady.yaml"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("margin: 2 %", "margin: 0.01 %"), encoding="utf-8")
    bench.commit("a margin below the scatter")
    bench.rebuild(commit=bench.head())
    done = accept(bench)
    assert done.returncode == 0, done.stderr
    assert "smoke fake-part: undecided, nothing is stored: fake/steady, overlap" in done.stdout
    assert ("fake-part", "smoke") not in stored(bench)


@pytest.mark.parametrize("why, spoiler", [
    ("CI is set", lambda bench, patch: patch.setenv("CI", "true")),
    ("(dirty)", lambda bench, patch: bench.rebuild(dirty="dirty")),
    ("not committed: notes.txt", lambda bench, patch: bench.write("notes.txt", "new\n")),
    ("MODIFIED", lambda bench, patch: bench.measure("--set", "value=0.0214")),
    ("--seed-offset", lambda bench, patch: bench.measure("--seed-offset", "5000")),
    ("claims.tsv:1: not the header", lambda bench, patch: bench.write("reference/claims.tsv", "id\n")),
])
def test_the_grounds_for_refusing_are_the_same(bench, monkeypatch, why, spoiler):
    spoiler(bench, monkeypatch)
    before = bench.table("claims")
    done = accept(bench)
    assert done.returncode == 2 and "nothing is accepted" in done.stderr and why in done.stderr
    assert bench.table("claims") == before


def test_a_failed_check_of_a_claims_case_is_refused(bench):
    path = bench.cases / "fake/steady.yaml"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("expect: 0.0213", "expect: 0.0233"), encoding="utf-8")
    bench.commit("a wrong expectation")
    bench.rebuild(commit=bench.head())
    done = accept(bench)
    assert done.returncode == 2 and "fake/steady: overlap [height_l=5.1] fails" in done.stderr
    assert not stored(bench)


def test_claims_are_a_choice_of_their_own(bench):
    assert "which cases?" in accept(bench, choice=["--claims", "--all-changed"]).stderr
    assert "--reason" in accept(bench, reason=None).stderr


@pytest.mark.parametrize("value, code", [("0.0213", 0), ("0.0233", 2)])
def test_what_a_paper_says_is_judged_too(bench, value, code):
    """A check against a published number fails or passes before anything is accepted."""
    path = bench.cases / "fake/steady.yaml"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("expect: 0.0213", "expect: {reference: published}"),
                    encoding="utf-8")
    bench.commit("a published expectation")
    bench.rebuild(commit=bench.head())
    bench.write("reference/fake/steady.tsv",
                "tier\tpoint\tobservable\torigin\tvalue\tdeviation\tseeds\tmeaning\tcommit\t"
                "solver_key\tdate\treason\nsmoke\theight_l=5.1\tbed.largest_overlap\tpublished\t"
                f"{value}\t1e-05\t0\t-\t-\t-\t2026-11-21\tread off Fig. 3\n")
    done = accept(bench)
    assert done.returncode == code, done.stderr
    assert ("overlap [height_l=5.1] fails" in done.stderr) == (code == 2)
    assert len(stored(bench)) == (0 if code else 2)
