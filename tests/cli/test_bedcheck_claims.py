"""Claims of the papers from the outside: listed, and refused where they name what is not there."""

import pytest

CASE = """\
name: fake/bed
title: t
source: s
question: q
model: fake
expect_s: 2
samples: [1]
observables: {bed: {recipe: contacts}}
checks:
  - {name: value, observable: bed.largest_overlap, expect: 1.37, margin: 3 %, scatter: 0.5 %, kind: model, because: b}
tiers: {smoke: {}}
"""

CLAIMS = """\
paper: FAKE
title: A. Fake, J. Fakes 1, 1 (1999)
claims:
  - id: fake-value
    where: Section II
    says: It is so.
    tests: [{case: fake/bed, check: value}]
    verdict: reproduced
    otherwise: not reproduced
    because: it must
"""

STORED = "id\ttier\tverdict\tcommit\tdate\treason\n{}\tsmoke\treproduced\t" + "a" * 40 + "\t2026-11-22\tfirst\n"


@pytest.fixture
def cases(tmp_path):
    for folder in ("cases/fake", "claims", "reference"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "cases/fake/bed.yaml").write_text(CASE)
    (tmp_path / "claims/fake.yaml").write_text(CLAIMS)
    return tmp_path / "cases"


def test_claims_are_listed_with_what_decides_them(bedcheck, cases):
    done = bedcheck("claims", "--cases", cases)
    assert done.returncode == 0 and done.stderr == ""
    assert "fake-value: FAKE, Section II" in done.stdout
    assert "pass fake/bed, value (smoke)" in done.stdout
    assert done.stdout.endswith("1 claims\n")


@pytest.mark.parametrize("command", ["list", "claims", "run"])
def test_an_unknown_check_is_refused_with_the_nearest(bedcheck, cases, tmp_path, command):
    (tmp_path / "claims/fake.yaml").write_text(CLAIMS.replace("check: value", "check: valeu"))
    out = ["--out", tmp_path / "out"] if command == "run" else []
    done = bedcheck(command, "--cases", cases, *out)
    assert done.returncode == 2
    assert "claims/fake.yaml:7:37: valeu: no such check; did you mean 'value'?" in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_stored_verdict_of_an_unknown_claim_is_refused(bedcheck, cases, tmp_path):
    stored = tmp_path / "reference/claims.tsv"
    stored.write_text(STORED.format("fake-value"))
    arguments = ("list", "--cases", cases, "--references", tmp_path / "reference")
    assert bedcheck(*arguments).returncode == 0
    stored.write_text(STORED.format("fake-valve"))
    done = bedcheck(*arguments)
    assert done.returncode == 2
    assert "claims.tsv:2: " in done.stderr and "did you mean 'fake-value'?" in done.stderr


def test_the_suite_has_claims_of_both_papers(bedcheck, root):
    done = bedcheck("claims", "--cases", root / "validation/cases")
    assert done.returncode == 0
    assert "mfm-fig4: MFM, Section III, Fig. 4" in done.stdout
    assert "fz-compaction-time: FZ, Section IV B, Fig. 4" in done.stdout
