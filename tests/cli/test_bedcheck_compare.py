"""bedcheck compare: every exit code, pairs, bits, costs, and input that is none."""

import json
import shutil

import h5py
import pytest

from bedcheck_fixtures import Bench, bench  # noqa: F401
from conftest import BIN, call

NOISY = """\
name: fake/noisy
title: A quantity with scatter
source: none, a test
question: Is a change seen?
model: fake
parameters: {value: 0.0213, noise: 2.1e-5}
samples: [0, 1.37]
seeds: {first: 1101, count: 4}
expect_s: 3
limit_s: 60
observables: {bed: {recipe: contacts}}
checks:
  - name: overlap
    observable: bed.largest_overlap
    expect: 0.0213
    margin: 10 %
    scatter: 2.1e-5
    kind: model
    because: the value is a parameter
tiers: {smoke: {}, paper: {}}
"""


@pytest.fixture(scope="session")
def kept(tmp_path_factory):
    """Folders of results by what they were made from: most tests begin with the same ones."""
    return tmp_path_factory.mktemp("kept"), {}


@pytest.fixture
def made(bench, kept):
    """made(NAME, words, text) -> a folder of results of its own, of the noisy case."""
    top, folders = kept

    def make(name, words=(), text=NOISY):
        if (words, text) not in folders:
            (top / str(len(folders))).mkdir()
            first = Bench(top / str(len(folders)))
            first.own_case("fake/noisy", text)
            first.run(*words)
            folders[words, text] = first.out
        bench.out = bench.folder / name
        shutil.copytree(folders[words, text], bench.out)
        return bench.out

    return make


@pytest.fixture
def pair(made):
    """pair(old words, new words) -> (folder, folder): the noisy case run twice."""
    return lambda old=(), new=(), text=NOISY: (made("old", tuple(old), text), made("new", tuple(new), text))


def compare(*words):
    return call(BIN / "bedcheck", "compare", *words)


def rows(*words):
    """{(case, check, point): row} and the whole, of the JSON."""
    done = compare(*words, "--json")
    whole = json.loads(done.stdout)
    assert whole["exit_code"] == done.returncode, done.stderr
    return {(r["case"], r["check"], r["point"]): r for r in whole["rows"]}, whole


def edit(folder, change):
    """Change a folder's results.json behind everybody's back."""
    path = folder / "results.json"
    data = json.loads(path.read_text(encoding="utf-8"))
    change(data)
    path.write_text(json.dumps(data), encoding="utf-8")


def test_the_same_bits_are_unchanged(pair):
    old, new = pair()
    done = compare(old, new)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.splitlines()[-1].startswith("NOTHING SIGNIFICANT: 1 checks in both: 1 unchanged")
    assert "4 runs in both, 4 unchanged, 0 differ" in done.stdout
    row = rows(old, new)[0][("fake/noisy", "overlap", "single")]
    assert row["change"] == "unchanged" and row["difference"] == 0


@pytest.mark.parametrize("value, sign", [("0.0214", 1), ("0.0212", -1)])
def test_a_change_is_significant_on_either_side(pair, value, sign):
    old, new = pair(new=("--set", f"value={value}"))
    found, whole = rows(old, new)
    row = found[("fake/noisy", "overlap", "single")]
    assert whole["exit_code"] == 1 and row["change"] == "significant"
    assert row["difference"] == pytest.approx(sign * 1e-4, rel=1e-6)
    assert row["difference_in_tolerances"] == pytest.approx(sign * 1e-4 / 2.13e-3, rel=1e-6)
    assert row["how"] == "paired, 4 seeds"
    text = compare(old, new).stdout
    assert f"MODIFIED: value={value}" in text and "SIGNIFICANT DIFFERENCE" in text
    assert "4 of 4 runs differ: first at 0 " in text


def test_scatter_is_no_change(pair):
    """Other noise of the same size: bits differ, statistics do not."""
    old, new = pair(new=("--set", "noise=-1.7e-5"))
    row = rows(old, new)[0][("fake/noisy", "overlap", "single")]
    assert row["change"] == "same" and row["difference"] != 0 and row["how"] == "separate"
    assert compare(old, new).returncode == 0


def test_more_seeds_than_one_are_needed_where_scatter_is_not_declared(pair):
    text = NOISY.replace("    scatter: 2.1e-5\n", "").replace("count: 4", "count: 2")
    old, new = pair(new=("--set", "noise=-1.7e-5"), text=text.replace("margin: 10 %", "margin: 1 %"))
    found, whole = rows(old, new)
    assert whole["exit_code"] == 3 and whole["conclusion"] == "TOO LITTLE DATA"
    row = found[("fake/noisy", "overlap", "single")]
    assert row["change"] == "undecided" and "too few data" in row["note"]


def test_another_case_text_is_not_comparable(made):
    old, new = made("old"), made("new", text=NOISY.replace("samples: [0, 1.37]", "samples: [0, 1.38]"))
    done = compare(old, new)
    assert done.returncode == 2 and "other case text: its runs are other ones" in done.stdout


def test_another_observable_of_the_same_runs_is_not_comparable(made):
    old, new = made("old"), made("new", text=NOISY.replace("bed.largest_overlap", "bed.solid_fraction_max"))
    assert rows(old, new)[1]["exit_code"] == 2


def test_other_seeds_are_not_comparable(pair):
    old, new = pair(new=("--seed-offset", "17"))
    done = compare(old, new)
    assert done.returncode == 2 and "other seeds" in done.stdout


def test_another_tier_is_not_comparable(pair):
    old, new = pair(new=("--tier", "paper"))
    done = compare(old, new)
    assert done.returncode == 2 and "the tiers differ: smoke and paper" in done.stdout
    assert json.loads(compare(old, new, "--json").stdout)["refusal"]


def test_another_margin_is_told_and_comparable(made):
    old, new = made("old"), made("new", text=NOISY.replace("margin: 10 %", "margin: 11 %"))
    done = compare(old, new)
    assert done.returncode == 0 and "tolerance 0.00213 -> 0.00234" in done.stdout


def test_added_and_removed_checks_are_listed(made):
    more = NOISY.replace("tiers:", """\
  - name: another
    observable: bed.solid_fraction_max
    expect: 0.37
    margin: 1 %
    scatter: 2.1e-8
    kind: model
    because: .37 and a thousandth of the overlap
tiers:""")
    old, new = made("old"), made("new", text=more)
    done = compare(old, new)
    assert done.returncode == 0 and "added  fake/noisy: another [single]" in done.stdout
    assert "removed  fake/noisy: another [single]" in compare(new, old).stdout


def test_nothing_in_common_is_not_comparable(made):
    old, new = made("old"), made("new", text=NOISY.replace("- name: overlap", "- name: renamed"))
    done = compare(old, new)
    assert done.returncode == 2 and "no check in common" in done.stdout


@pytest.mark.parametrize("mode", ["crash", "nan"])
def test_a_run_that_fails_now_is_significant(pair, mode):
    old, new = pair(new=("--set", f"mode={mode}"))
    done = compare(old, new)
    assert done.returncode == 1 and "fails now, and did not before" in done.stdout
    assert "there is no number any more" in done.stdout
    done = compare(new, old)
    assert done.returncode == 1 and "failed before, and does not any more" in done.stdout


def test_what_fails_on_both_sides_proves_nothing(pair):
    old, new = pair(("--set", "mode=crash"), ("--set", "mode=crash"))
    assert compare(old, new).returncode == 3


def test_values_that_cancel_in_the_mean_are_a_change_where_nothing_scatters(pair):
    old, new = pair(text=NOISY.replace("scatter: 2.1e-5", "scatter: 0"))

    def cancel(data):
        value = data["checks"][0]["values"]
        value[0] += 1e-4
        value[1] -= 1e-4

    edit(new, cancel)
    found, whole = rows(old, new)
    assert whole["exit_code"] == 1 and found[("fake/noisy", "overlap", "single")]["how"] == "without scatter"


def test_rounding_is_no_change(pair):
    old, new = pair(text=NOISY.replace("scatter: 2.1e-5", "scatter: 0"))

    def nudge(data):
        data["checks"][0]["values"][0] *= 1 + 3e-12

    edit(new, nudge)
    found, whole = rows(old, new)
    assert whole["exit_code"] == 0 and found[("fake/noisy", "overlap", "single")]["change"] == "same"


@pytest.mark.parametrize("factor, parted", [(1 + 1e-15, None), (1 + 3e-5, None), (1.01, 1.37)])
def test_the_first_sample_that_differs_is_found(pair, factor, parted):
    old, new = pair()
    name = sorted((new / "h5").glob("*.h5"))[2]
    with h5py.File(name, "a") as file:
        file["observables/largest_overlap/value"][1] *= factor
    runs = {r["name"]: r for r in rows(old, new)[1]["runs"]}
    run = runs.pop(name.stem)
    assert run["bits"] == "differ" and run["first_time"] == 1.37 and run["parted_time"] == parted
    assert run["first_dataset"] == "observables/largest_overlap" and run["first_step"] == 1
    assert run["first_size"] == pytest.approx(1 - 1 / factor, rel=0.3)
    assert all(r["bits"] == "unchanged" and r["first_time"] is None for r in runs.values())


def test_costs_are_paired_by_run(pair):
    old, new = pair()
    for number, name in enumerate(sorted(p.stem for p in (old / "h5").glob("*.h5"))):
        for folder, factor in ((old, 1), (new, 1.37)):
            seconds = (0.7 + 3.1 * number) * factor * (1 + 1e-4 * number)
            record = {"format": "bedsim-record 1", "cpu_s": 2 * seconds, "cost": {"halo_s": seconds, "steps": 3}}
            (folder / "h5" / f"{name}.run.json").write_text(json.dumps(record), encoding="utf-8")
    cost = {c["part"]: c for c in rows(old, new)[1]["cost"]}
    assert set(cost) == {"fake: halo", "processor time, all parts", "wall-clock time"}
    halo = cost["fake: halo"]
    assert halo["runs"] == 4 and halo["ratio"] == pytest.approx(1.37) and halo["told"] == "slower"
    assert rows(new, old)[1]["cost"][0]["told"] == "faster"
    assert rows(old, old)[1]["cost"][0]["told"] == "no difference seen"


def test_results_that_are_gone_leave_the_bits_unknown(pair):
    old, new = pair()
    for path in (new / "h5").glob("*.h5"):
        path.unlink()
    done = compare(old, new)
    assert done.returncode == 0 and "4 of 4 runs cannot be read" in done.stdout


def test_markdown_fits_a_comment_and_is_escaped(pair):
    old, new = pair(new=("--set", "value=0.0214"))

    def swell(data):
        row = data["checks"][0]
        data["checks"] = [dict(row, check=f"check <b>|{i}") for i in range(2000)]

    for folder in (old, new):
        edit(folder, swell)
    done = compare(old, new, "--markdown")
    assert done.returncode == 1 and done.stdout.startswith("# SIGNIFICANT DIFFERENCE\n")
    assert len(done.stdout) <= 65536 and "more do not fit in here" in done.stdout
    assert "<b>" not in done.stdout


@pytest.mark.parametrize(
    "spoil, said",
    [
        (lambda d: d.pop("tier"), "tier is missing"),
        (lambda d: d["checks"][0].pop("values"), "values is missing"),
        (lambda d: d.update(schema="bedcheck-results 7"), "bedcheck-results 7"),
        (lambda d: d.update(checks={}), "checks: must be a list"),
        (lambda d: d["checks"].append(3), "each must be a map"),
        (lambda d: d["checks"][0].update(measured="1.2"), "measured"),
        (lambda d: d["checks"][0].update(runs=["../../etc/passwd"]), "not the name of a run"),
        (lambda d: d["checks"][0]["seeds"].pop(), "4 values of 3 seeds"),
        (lambda d: d["counts"].update({"pass": -3}), "must not be negative"),
    ],
)
def test_damaged_results_are_refused(pair, spoil, said):
    old, new = pair()
    edit(new, spoil)
    done = compare(old, new)
    assert done.returncode == 2 and said in done.stderr and "results.json:" in done.stderr, done.stderr
    assert done.stdout == ""


@pytest.mark.parametrize("text", ["", "{", "not json at all: [", "[1, 2]", '{"tier": NaN}', "\0\0\0"])
def test_what_is_no_json_is_refused(pair, text):
    old, new = pair()
    (new / "results.json").write_text(text, encoding="utf-8")
    assert compare(old, new).returncode == 2


def test_bad_usage(pair, tmp_path):
    old, new = pair()
    for words in ([], [old, new, old], [old, tmp_path / "none"], [old, new, "--level", "0"],
                  [old, new, "--level", "x"], [old, new, "--json", "--markdown"]):
        done = compare(*words)
        assert done.returncode == 2 and done.stderr, words


COLUMNS = ["tier", "point", "observable", "origin", "value", "deviation", "seeds", "meaning", "commit", "solver_key",
           "date", "reason"]


@pytest.fixture
def stored(bench, made):
    """stored(mean, deviation, seeds, **columns): the noisy case run, and references of it."""
    made("out")

    def write(mean, deviation, seeds=40, **other):
        row = bench.results()["checks"][0]
        line = dict(tier="smoke", point="-", observable=row["key"], origin="ensemble", value=mean, deviation=deviation,
                    seeds=seeds, meaning=row["meaning"], commit="0" * 40, solver_key="1" * 64, date="2026-11-20",
                    reason="a test")
        line.update(other)
        folder = bench.folder / "reference"
        (folder / "fake").mkdir(parents=True, exist_ok=True)
        text = "# references\n" + "\t".join(COLUMNS) + "\n" + "\t".join(str(line[c]) for c in COLUMNS) + "\n"
        (folder / "fake" / "noisy.tsv").write_text(text, encoding="utf-8")
        return [bench.out, "--references", folder]

    return write


@pytest.mark.parametrize("offset, code", [(0.3, 0), (-0.3, 0), (4, 1), (-4, 1)])
def test_a_folder_is_compared_with_an_ensemble(stored, bench, offset, code):
    """s = 2.1e-5, n = 4, K = 40: one standard uncertainty is 1.1e-5, t(39) at 1e-3 3.56, halved 3.79."""
    words = stored(0.0213, 2.1e-5)
    mean = bench.results()["checks"][0]["measured"] - offset * 2.1e-5
    words = stored(mean, 2.1e-5)
    found, whole = rows(*words)
    row = found[("fake/noisy", "overlap", "single")]
    assert whole["exit_code"] == code, whole["conclusion"]
    assert row["difference"] == pytest.approx(offset * 2.1e-5, rel=1e-9)
    assert row["uncertainty"] == pytest.approx(2.1e-5 * (1 / 4 + 1 / 40) ** 0.5)
    assert "accepted until 2026-11-20" in compare(*words).stdout


def test_a_reference_of_another_case_text_is_not_comparable(stored):
    done = compare(*stored(0.0213, 2.1e-5, meaning="deadbeef"))
    assert done.returncode == 2 and "the reference is of another case text" in done.stdout


def test_no_reference_is_not_comparable(stored, bench):
    done = compare(*stored(0.0213, 2.1e-5, tier="paper"))
    assert done.returncode == 2 and "there is no ensemble" in done.stdout
    assert compare(bench.out, "--references", bench.folder / "none").returncode == 2


def test_damaged_references_are_refused(stored):
    done = compare(*stored(0.0213, 2.1e-5, seeds=31))
    assert done.returncode == 2 and "noisy.tsv:3" in done.stderr
