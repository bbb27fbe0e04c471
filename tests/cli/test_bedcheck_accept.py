"""bedcheck accept: how results become references, and every ground for refusing."""

import hashlib
import json
import math
import os
import re
import shutil
import statistics
import subprocess

import h5py
import pytest

from bedcheck_fixtures import Bench

CASE = """
name: fake/steady
title: A quantity with scatter
source: none, a test
question: Does the fake solver give the value that it was told to give?
model: fake
parameters: {value: 0.0213, noise: 2.1e-5, mode: good}
sweep: {height_l: [3.7, 5.1]}
samples: [0, 1.37]
seeds: {first: 1101, count: 4}
expect_s: 3
limit_s: 60
observables: {bed: {recipe: contacts}}
checks:
  - name: overlap
    observable: bed.largest_overlap
    expect: 0.0213
    margin: 2 %
    kind: model
    because: the value is a parameter, the scatter of 4 seeds .1 %
  - name: solid fraction
    observable: bed.solid_fraction_max
    expect: 0.37
    margin: 0.001
    kind: round-off
    because: .37 and a thousandth of the overlap
  - name: unchanged
    observable: bed.largest_overlap
    kind: regression
    detects: 2 %
    because: twenty times the scatter
tiers:
  smoke: {}
  paper: {}
"""

SECOND = """
name: fake/second
title: The same runs once more
source: none, a test
question: Are bits stored where nothing has scatter?
model: fake
runs_of: fake/steady
observables: {bed: {recipe: contacts}}
checks:
  - name: solid fraction
    observable: bed.solid_fraction_max
    expect: 0.37
    margin: 0.001
    kind: round-off
    because: .37 and a thousandth of the overlap
  - name: pair
    observable: bed.solid_fraction_max
    kind: regression
    paired: true
    margin: 1e-9
    detects: 1e-8
    because: the same seed of the same build gives the same number
tiers: {smoke: {}, paper: {}}
"""

SEEDS = 34


class Checkout(Bench):
    """A bench whose cases and references stand in a git checkout of their own."""

    def __init__(self, folder):
        super().__init__(folder)
        self.top = folder / "tree"
        self.cases = self.top / "cases"
        self.references = self.top / "reference"

    def create(self):
        self.references.mkdir(parents=True)
        self.write("cases/fake/steady.yaml", CASE)
        self.write("cases/fake/second.yaml", SECOND)
        self.git("init", "-q")
        self.commit("cases")

    def git(self, *words):
        done = subprocess.run(["git", "-C", self.top, "-c", "user.name=T", "-c", "user.email=t@t",
                               *words], capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def head(self):
        return self.git("rev-parse", "HEAD")

    def write(self, name, text):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def commit(self, message):
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", message)

    def measure(self, *words, seeds=2):
        """New runs, few: what is refused without a look at their numbers."""
        if self.out.exists():
            self.bedcheck("clean", self.out)
        done = self.run("fake/*", "--references", self.references, "--seeds", seeds, *words)
        assert done.returncode in (0, 1, 3), done.stdout + done.stderr

    def records(self):
        return sorted((self.out / "h5").glob("*.run.json"))

    def rebuild(self, records=None, **build):
        """As if runs had been made by another build of the solver."""
        for path in self.records() if records is None else records:
            record = json.loads(path.read_text(encoding="utf-8"))
            record["build"].update(build)
            path.write_text(json.dumps(record), encoding="utf-8")

    def shift(self, amount):
        """As if the solver gave another overlap."""
        for path in (self.out / "h5").glob("*.h5"):
            with h5py.File(path, "r+") as file:
                file["observables/largest_overlap/value"][...] += amount

    def as_tier(self, tier):
        record = self.out / "bedcheck.yaml"
        text = record.read_text(encoding="utf-8")
        record.write_text(re.sub('^tier: .*$', f'tier: "{tier}"', text, flags=re.M), encoding="utf-8")

    def accept(self, *words, reason="first set", choice=("--case", "fake/*")):
        said = [] if reason is None else ["--reason", reason]
        return self.bedcheck("accept", self.out, "--cases", self.cases, "--references",
                             self.references, *choice, *said, *words)

    def table(self, name="fake/steady"):
        """Lines of a table as dictionaries."""
        path = self.references / f"{name}.tsv"
        if not path.exists():
            return []
        lines = [x for x in path.read_text(encoding="utf-8").splitlines() if not x.startswith("#")]
        head = lines[0].split("\t")
        return [dict(zip(head, line.split("\t"))) for line in lines[1:]]

    def files(self):
        return sorted(str(p.relative_to(self.references)) for p in self.references.rglob("*")
                      if p.is_file())


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A checkout with results of 34 seeds, made once."""
    bench = Checkout(tmp_path_factory.mktemp("made"))
    bench.create()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FAKE_BUILD", json.dumps(
            {"commit": bench.head(), "dirty": "clean", "compiler": "gcc 12.2.0", "flags": "-O2",
             "machine": "x86_64", "libc": "glibc 2.36"}))
        bench.measure(seeds=SEEDS)
    return bench


def fresh_copy(made, folder, monkeypatch):
    """A copy of a checkout and its results below folder, for one test."""
    monkeypatch.delenv("CI", raising=False)
    monkeypatch.setenv("FAKE_BUILD", json.dumps({"commit": made.head(), "dirty": "clean"}))
    shutil.copytree(made.top, folder / "tree")
    shutil.copytree(made.out, folder / "out")
    return Checkout(folder)


@pytest.fixture
def bench(made, tmp_path, monkeypatch):
    return fresh_copy(made, tmp_path, monkeypatch)


def ensembles(table):
    return [line for line in table if line["origin"] == "ensemble"]


def bits(table):
    return [line for line in table if line["origin"] == "bits"]


def lines_of(path):
    return path.read_text(encoding="utf-8").splitlines(keepends=True)


def add_line(path, line):
    lines = lines_of(path)
    path.write_text("".join(lines[:2] + sorted(lines[2:] + [line], key=str.encode)), encoding="utf-8")


def test_accept_writes_a_sorted_table_with_its_history(bench):
    done = bench.accept()
    assert done.returncode == 0, done.stderr
    assert "none -> 0.021" in done.stdout and "2 of 2 cases changed" in done.stdout
    assert bench.files() == ["fake/second.tsv", "fake/steady.tsv"]
    table = bench.table()
    assert [x["point"] for x in ensembles(table)] == ["height_l=3.7", "height_l=5.1"]
    one = ensembles(table)[0]
    assert one["tier"] == "smoke" and one["observable"] == "bed.largest_overlap"
    assert float(one["value"]) == pytest.approx(0.0213, abs=2e-5)
    assert float(one["deviation"]) == pytest.approx(2.1e-5, rel=0.5) and one["seeds"] == str(SEEDS)
    assert one["commit"] == bench.head() and one["reason"] == "first set"
    assert one["solver_key"] == hashlib.sha256(bench.solver.read_bytes()).hexdigest()
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", one["date"])
    # bits of the case's own four seeds at two points, not of all 34
    assert len(bits(table)) == 8 and {x["observable"] for x in bits(table)} == {
        f"bits@{seed}" for seed in range(1101, 1105)}
    assert all(x["value"].startswith("gcc-12/-O2/x86_64/glibc-2.36:") for x in bits(table))
    assert bits(bench.table("fake/second")) and not ensembles(bench.table("fake/second"))
    text = lines_of(bench.references / "fake/steady.tsv")[2:]
    assert text == sorted(text, key=str.encode)


def test_mean_and_deviation_are_those_of_the_results(bench):
    bench.accept()
    for line in ensembles(bench.table()):
        values = []
        for path in (bench.out / "h5").glob("*.h5"):
            text = next((bench.out / "runs").glob(path.name.rsplit("-s", 1)[0] + ".yaml"))
            if f"height_l: {line['point'].split('=')[1]}" in text.read_text(encoding="utf-8"):
                with h5py.File(path) as file:
                    values.append(float(file["observables/largest_overlap/value"][-1]))
        assert len(values) == SEEDS
        assert float(line["value"]) == pytest.approx(statistics.mean(values), rel=1e-14)
        assert float(line["deviation"]) == pytest.approx(statistics.stdev(values), rel=1e-9)


def test_paired_checks_get_the_values_of_the_own_seeds(bench):
    bench.accept()
    pairs = [x for x in bench.table("fake/second") if x["origin"] == "seed"]
    assert [x["observable"] for x in pairs] == [
        f"bed.solid_fraction_max@{seed}" for seed in range(1101, 1105)] * 2
    for line in pairs:
        assert float(line["value"]) == pytest.approx(0.3700213, abs=1e-6)
        assert line["deviation"] == "-" and line["seeds"] == "1"


def judge(bench):
    """Exit code of judging the folder again, and what became of the regression checks."""
    done = bench.bedcheck("check", bench.out, "--cases", bench.cases, "--references",
                          bench.references)
    found = {c["verdict"] for c in bench.results()["checks"] if c["kind"] == "regression"}
    return done.returncode, found


def test_no_reference_passes_by_itself(bench):
    assert judge(bench) == (3, {"inconclusive"}) and bench.files() == []  # none is made on the spot
    bench.accept(choice=["--case", "fake/steady"])
    path = bench.references / "fake/steady.tsv"
    text = "".join(lines_of(path))
    path.write_text(text.replace("bed.largest_overlap", "bed.largest_overlp"), encoding="utf-8")
    code, verdicts = judge(bench)
    assert code in (2, 3) and verdicts <= {"inconclusive"}  # a mistyped one is none
    path.write_text(text.replace("smoke", "paper"), encoding="utf-8")
    code, verdicts = judge(bench)
    assert code in (2, 3) and verdicts <= {"inconclusive"}  # nor is that of another tier
    meaning = ensembles(bench.table())[0]["meaning"]
    path.write_text(text.replace(meaning, "01234567"), encoding="utf-8")
    assert judge(bench) == (3, {"inconclusive", "pass"})  # nor that of another text


def test_accepted_references_judge_what_comes_after(bench):
    bench.accept(choice=["--case", "fake/steady"])
    code, verdicts = judge(bench)
    assert code == 3 and verdicts == {"pass", "inconclusive"}  # fake/second has none yet
    bench.shift(4e-4)  # 2 % of the overlap
    assert judge(bench) == (1, {"fail", "inconclusive"})


def test_only_what_changes_is_written_and_told_in_units_of_its_uncertainty(bench):
    bench.accept()
    old = ensembles(bench.table())
    done = bench.accept("--dry-run", choice=["--all-changed"])
    assert done.returncode == 0 and "0 of 2 cases" in done.stdout and "fake" not in done.stderr
    bench.shift(1e-5)
    done = bench.accept(choice=["--case", "fake/steady"], reason="a new value")
    assert done.returncode == 0 and "1 of 1 cases changed" in done.stdout, done.stderr
    told = [float(x) for x in re.findall(r", \+([0-9.]+) u\n", done.stdout)]
    units = [1e-5 / (float(x["deviation"]) * math.sqrt(2 / SEEDS)) for x in old]
    assert told == pytest.approx(units, abs=0.051)
    assert "0 new, 8 changed" in done.stdout
    new = bench.table()
    assert {x["reason"] for x in new} == {"a new value"}
    assert [float(x["value"]) for x in ensembles(new)] == pytest.approx(
        [float(x["value"]) + 1e-5 for x in old], rel=1e-12)


def test_unchanged_lines_keep_their_history(bench):
    bench.accept(reason="first set")
    first = bench.table()
    bench.commit("references")
    bench.rebuild(commit=bench.head())
    done = bench.accept(reason="second set")
    assert done.returncode == 0 and "nothing changed" in done.stdout
    assert bench.table() == first


def test_another_case_text_is_told(bench):
    bench.accept()
    path = bench.references / "fake/steady.tsv"
    meaning = ensembles(bench.table())[0]["meaning"]
    path.write_text("".join(lines_of(path)).replace(meaning, "01234567"), encoding="utf-8")
    done = bench.accept(reason="another text")
    assert done.returncode == 0 and "the case text is another" in done.stdout
    assert [x["reason"] for x in ensembles(bench.table())] == ["another text", "first set"]


def test_a_dry_run_writes_nothing(bench):
    done = bench.accept("--dry-run")
    assert done.returncode == 0 and "would change" in done.stdout and bench.files() == []


def test_lines_that_nothing_gives_any_more_go_and_others_stay(bench):
    bench.as_tier("paper")
    assert bench.accept().returncode == 0
    published = "paper\theight_l=3.7\tbed.largest_overlap\tpublished\t0.0213\t1e-3\t0\t-\t-\t-\t" \
                "2026-11-21\tread off Fig. 3\n"
    add_line(bench.references / "fake/steady.tsv", published)
    paper = bench.table()
    assert len(paper) == 3  # no bits but in the smoke tier
    bench.as_tier("smoke")
    gone = "smoke\theight_l=3.7\tbed.mistyped\tensemble\t0.0213\t1e-3\t40\t01234567\t" \
           f"{'ab' * 20}\t{'cd' * 32}\t2026-11-21\tof an earlier case\n"
    add_line(bench.references / "fake/steady.tsv", gone)
    done = bench.accept()
    assert done.returncode == 0 and "bed.mistyped: 0.0213 (40 seeds" in done.stdout
    assert "-> none" in done.stdout
    table = bench.table()
    assert [x for x in table if x["tier"] == "paper"] == paper and len(ensembles(table)) == 4
    assert not any("mistyped" in x["observable"] for x in table)


def test_bits_of_another_build_stay_while_this_one_is_unchanged(bench):
    bench.accept()
    bench.rebuild(compiler="clang 14.0.6")
    assert bench.accept().returncode == 0
    classes = [x["value"].split(":")[0].split("/")[0] for x in bits(bench.table())]
    assert classes == ["clang-14", "gcc-12"] * 8
    bench.shift(1e-5)
    assert bench.accept().returncode == 0
    assert {x["value"].split("/")[0] for x in bits(bench.table())} == {"clang-14"}


# -- grounds for refusing -----------------------------------------------------------------


def refused(bench, why, *words, **choices):
    """Nothing is accepted, nothing is written, and the fault says why."""
    before = bench.files(), [bench.table(n) for n in ("fake/steady", "fake/second")]
    done = bench.accept(*words, **choices)
    assert done.returncode == 2 and "nothing is accepted" in done.stderr, done.stdout
    assert why in done.stderr, done.stderr
    assert (bench.files(), [bench.table(n) for n in ("fake/steady", "fake/second")]) == before
    return done


def test_no_server_accepts(bench, monkeypatch):
    monkeypatch.setenv("CI", "true")
    refused(bench, "CI is set")
    refused(bench, "CI is set", "--dry-run")


@pytest.mark.parametrize("reason", [None, "", "  -- ", "two\nlines"])
def test_a_reason_is_needed(bench, reason):
    refused(bench, "--reason", reason=reason)


def test_cases_have_to_be_named(bench):
    refused(bench, "which cases?", choice=[])
    refused(bench, "which cases?", choice=["--case", "fake/steady", "--all-changed"])
    refused(bench, "--case fake/stead:", choice=["--case", "fake/stead"])


@pytest.mark.parametrize("build, why", [
    ({"dirty": "dirty"}, "(dirty)"),
    ({"dirty": "unknown"}, "(unknown)"),
    ({"commit": "unknown", "dirty": "unknown"}, "commit unknown"),
    ({"commit": "0123456789" * 4}, "which this checkout does not have"),
    ({"commit": "--output=/tmp/x"}, "made by a build of commit --output="),
])
def test_other_builds_than_head_are_refused(bench, build, why):
    bench.rebuild(**build)
    refused(bench, why)


def test_one_run_of_another_build_is_enough_to_refuse(bench):
    record = bench.records()[40]
    bench.rebuild([record], dirty="dirty")
    refused(bench, f"{record.name[:-9]}: made by a build")


def test_results_without_a_record_are_refused(bench):
    bench.records()[17].unlink()
    refused(bench, "commit unknown")


def test_a_commit_behind_head_is_refused_but_not_for_references(bench):
    old = bench.head()
    bench.write("reference/fake/README", "a change below reference/ only\n")
    bench.commit("references")
    assert bench.head() != old
    assert bench.accept("--dry-run").returncode == 0
    bench.write("solver.c", "int x;\n")
    bench.commit("code")
    refused(bench, f"{old[:12]}, not of HEAD")


def test_uncommitted_work_is_refused_but_not_among_references(bench):
    bench.write("reference/fake/README", "new\n")
    assert bench.accept("--dry-run").returncode == 0
    bench.write("notes.txt", "new\n")
    refused(bench, "not committed: notes.txt")


def test_bedcheck_has_to_be_of_the_same_commit_as_its_own_tree(bench):
    bench.write("validation/bedcheck.c", "/* as if this were its tree */\n")
    bench.commit("its own tree")
    refused(bench, "this bedcheck is of commit")


def test_outside_a_checkout_nothing_is_accepted(bench):
    (bench.top / ".git").rename(bench.folder / "elsewhere")
    refused(bench, "is in no git checkout")


def test_modified_results_are_refused(bench):
    bench.measure("--set", "value=0.0214")
    refused(bench, "MODIFIED: made with --set value=0.0214")


def test_fresh_seeds_are_refused(bench):
    bench.measure("--seed-offset", "5000")
    refused(bench, "--seed-offset 5000")


def test_a_failed_check_is_refused(bench):
    bench.write("cases/fake/steady.yaml", CASE.replace("expect: 0.0213", "expect: 0.0223"))
    bench.commit("a wrong expectation")
    bench.rebuild(commit=bench.head())
    refused(bench, "fake/steady: overlap [height_l=3.7] fails")
    assert bench.accept(choice=["--case", "fake/second"]).returncode == 0  # no fault of that one


def blow_up(bench, value):
    """One run of 68 gives another overlap, and no model check looks at it."""
    text = CASE[:CASE.index("  - name: overlap")] + CASE[CASE.index("  - name: solid"):]
    bench.write("cases/fake/steady.yaml", text)
    bench.commit("no model check")
    bench.rebuild(commit=bench.head())
    if value is not None:
        with h5py.File(sorted((bench.out / "h5").glob("*.h5"))[20], "r+") as file:
            file["observables/largest_overlap/value"][-1] = value
    return {"choice": ["--case", "fake/steady"]}


@pytest.mark.parametrize("value, why", [
    (math.nan, "run with seed"),
    (math.inf, "run with seed"),
    (1.7e8, "check unchanged at height_l="),
    (0.0513, "says that it detects 2 %"),
])
def test_a_diverging_run_pins_no_reference(bench, value, why):
    choice = blow_up(bench, value)
    refused(bench, why, **choice)


def test_the_same_runs_without_it_are_accepted(bench):
    assert bench.accept(**blow_up(bench, None)).returncode == 0


def test_a_failed_run_is_refused(bench):
    bench.write("cases/fake/steady.yaml", CASE.replace("mode: good", "mode: numerical"))
    bench.commit("a solver that gives up")
    bench.measure()
    refused(bench, "run with seed 1101")


def test_too_few_seeds_are_refused(bench):
    bench.measure()
    done = refused(bench, "have 2 seeds or fewer, an ensemble needs 32")
    assert "bedcheck calibrate" in done.stderr


def test_every_ground_is_told_at_once(bench, monkeypatch):
    bench.write("notes.txt", "new\n")
    bench.rebuild(dirty="dirty")
    monkeypatch.setenv("CI", "true")
    done = refused(bench, "CI is set", reason=None)
    assert all(x in done.stderr for x in ("--reason", "notes.txt", "(dirty)"))


def test_a_changed_case_text_needs_new_runs(bench):
    bench.write("cases/fake/steady.yaml", CASE.replace("[0, 1.37]", "[0, 1.38]"))
    bench.commit("other samples")
    refused(bench, "missing or were made otherwise")


def test_a_table_that_cannot_be_read_stops_all(bench):
    bench.write("reference/fake/steady.tsv", "tier\tpoint\n")
    refused(bench, "fake/steady.tsv:1: not the header")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_written_is_left_as_it_was(bench):
    bench.references.chmod(0o555)
    refused(bench, str(bench.references))
    bench.references.chmod(0o755)
