"""Every kind of check, from the solver to the exit code: right data pass, planted faults fail."""

import pytest

from bedcheck_fixtures import Bench

HEAD = """\
name: fake/{name}
title: t
source: s
question: q
model: fake
{parameters}
samples: [0, 1.37]
expect_s: 1
seeds: {{first: 21, count: {seeds}}}
observables: {{bed: {{recipe: contacts}}}}
"""
KINDS = HEAD.format(name="kinds", parameters="parameters: {value: 0.0213, noise: 2.1e-5}", seeds=3) + """\
checks:
  - {name: within, observable: bed.largest_overlap, kind: model, expect: 0.0213, margin: 2 %,
     scatter: 2.1e-5, because: b}
  - {name: at most, observable: bed.largest_overlap, kind: model, expect: 0.0217,
     comparison: at most, scatter: 2.1e-5, because: b}
  - {name: at least, observable: bed.largest_overlap, kind: model, expect: 0.0209,
     comparison: at least, scatter: 2.1e-5, because: b}
  - {name: outside, observable: bed.largest_overlap, kind: model, expect: 0.0223, margin: 3 %,
     comparison: outside, scatter: 2.1e-5, because: b}
  - {name: round-off, observable: bed.solid_fraction_max, kind: round-off, expect: 0.3700213,
     margin: 3e-7, because: b}
  - {name: published, observable: bed.largest_overlap, kind: model, expect: {reference: published},
     margin: 2 %, scatter: 2.1e-5, because: b}
  - {name: regression, observable: bed.largest_overlap, kind: regression, detects: 3 %, because: b}
  - {name: paired, observable: bed.solid_fraction_max, kind: regression, paired: true,
     margin: 3e-7, detects: 6e-7, because: b}
  - {name: known, observable: bed.largest_overlap, kind: model, expect: 0.0223, margin: 2 %,
     scatter: 2.1e-5, because: b, known: {because: a finding, since: 2026-11-20}}
tiers: {smoke: {}}
"""
ORDER = HEAD.format(name="order", parameters="parameters: {value: 0, slope: 1.7e-4}\n"
                                             "sweep: {width_l: [3, 6, 12]}", seeds=1) + """\
across: {fit: {fit: order, of: bed.largest_overlap, along: width_l, exact: true}}
checks:
  - {name: order, observable: fit.order, kind: order, expect: 2, margin: 0.01, because: b}
tiers: {smoke: {}}
"""
CLAIMS = """\
paper: FAKE
title: A. Fake, J. Fakes 1, 1 (1999)
claims:
  - id: fake-value
    where: Section II
    says: It is .0213.
    tests: [{case: fake/kinds, check: within}]
    verdict: reproduced
    otherwise: not reproduced
    because: it must
"""
HEADER = "tier point observable origin value deviation seeds meaning commit solver_key date reason"


def table(path, header, lines):
    path.parent.mkdir(parents=True, exist_ok=True)
    text = ["\t".join(map(str, line)) for line in lines]
    path.write_text("\n".join([header.replace(" ", "\t"), *sorted(text)]) + "\n", encoding="utf-8")


class Kinds(Bench):
    """All kinds of check, with references that the right solver's own runs gave."""

    def prepare(self):
        self.own_case("fake/kinds", KINDS)
        self.own_case("fake/order", ORDER)
        (self.folder / "claims").mkdir()
        (self.folder / "claims/fake.yaml").write_text(CLAIMS, encoding="utf-8")
        self.go()
        row = {c["check"]: c for c in self.results()["checks"]}
        ours = ("01" * 20, "ab" * 32)
        last = ("2026-11-22", "a test")
        pairs = row["paired"]
        table(self.folder / "reference/fake/kinds.tsv", HEADER, [
            ("smoke", "-", "bed.largest_overlap", "published", 0.0213, 1e-5, 0, "-", "-", "-", *last),
            ("smoke", "-", "bed.largest_overlap", "ensemble", 0.0213, 2.1e-5, 40,
             row["regression"]["meaning"], *ours, *last),
            *(("smoke", "-", f"bed.solid_fraction_max@{seed}", "seed", repr(value), "-", 1,
               pairs["meaning"], *ours, *last)
              for seed, value in zip(pairs["seeds"], pairs["values"]))])
        table(self.folder / "reference/claims.tsv", "id tier verdict commit date reason",
              [("fake-value", "smoke", "reproduced", "01" * 20, *last)])

    def go(self, *plant):
        """{check: verdict} and the exit code, from a solver with these settings in its program."""
        self.build_solver("anew")
        if plant:
            words = " ".join(f"--set {p}" for p in plant)
            text = self.solver.read_text(encoding="utf-8").replace('"$@"', f'"$@" {words}')
            self.solver.write_text(text, encoding="utf-8")
        done = self.run("--references", self.folder / "reference")
        assert done.returncode in (0, 1, 3), done.stdout + done.stderr
        assert not self.results()["modified"]
        return {c["check"]: c["verdict"] for c in self.results()["checks"]}, done.returncode


@pytest.fixture(scope="module")
def kinds(tmp_path_factory):
    kinds = Kinds(tmp_path_factory.mktemp("kinds"))
    (kinds.folder / "reference").mkdir()
    kinds.prepare()
    return kinds


def test_right_data_pass(kinds):
    verdicts, code = kinds.go()
    assert verdicts.pop("known") == "known" and set(verdicts.values()) == {"pass"} and code == 0
    assert set(verdicts) == {"within", "at most", "at least", "outside", "round-off", "published",
                             "regression", "paired", "order", "claim fake-value"}


@pytest.mark.parametrize("value, fails", [
    # 5 % up: the known disagreement (.0223) agrees now, which fails as well
    (0.0224, {"within", "at most", "outside", "round-off", "published", "regression", "paired",
              "known", "claim fake-value"}),
    (0.0202, {"within", "at least", "round-off", "published", "regression", "paired",
              "claim fake-value"}),
])
def test_a_wrong_solver_fails_every_kind(kinds, value, fails):
    verdicts, code = kinds.go(f"value={value}")
    assert {name for name, v in verdicts.items() if v == "fail"} - {"order"} == fails and code == 1


def test_a_wrong_order_fails(kinds):
    verdicts, code = kinds.go("width_l=5")  # whatever the lattice: no order at all
    assert verdicts["order"] == "fail" and code == 1


@pytest.mark.parametrize("mode", ["nan", "numerical", "short", "missing"])
def test_no_data_never_pass(kinds, mode):
    verdicts, code = kinds.go(f"mode={mode}")
    assert code == 1 and "pass" not in {v for name, v in verdicts.items() if "claim" not in name}
