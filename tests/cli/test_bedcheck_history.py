"""bedcheck history: one line a run of the suite, and their trends."""

import json
import shutil

import pytest

from bedcheck_fixtures import Bench, bench  # noqa: F401
from conftest import BIN, call


def history(*words):
    return call(BIN / "bedcheck", "history", *words)


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """The fake cases, run once for all tests."""
    made = Bench(tmp_path_factory.mktemp("first"))
    assert made.run("fake/*").returncode == 0
    return made.out


@pytest.fixture
def kept(bench, first):
    """Results of the fake cases, and a file of their history."""
    shutil.copytree(first, bench.out)
    file = bench.folder / "trend.jsonl"
    done = history(bench.out, "--file", file)
    assert done.returncode == 0 and "added" in done.stdout, done.stderr
    return bench, file


def rebuild(bench):
    """Results as of another build of the solver."""
    path = bench.out / "results.json"
    data = json.loads(path.read_text(encoding="utf-8"))
    data["solver_key"] = "f" * 64
    path.write_text(json.dumps(data), encoding="utf-8")


def lines(file):
    text = file.read_text(encoding="utf-8")
    assert text.endswith("\n")
    return [json.loads(line) for line in text.splitlines()]


def test_a_line_sums_up_the_folder(kept):
    bench, file = kept
    (line,) = lines(file)
    results = bench.results()
    assert line["schema"] == "bedcheck-history 1" and line["tier"] == "smoke"
    assert line["started"] == results["started"] and line["commit"] == "unknown"
    assert line["counts"]["pass"] == 8 and line["verdict"] == "pass"
    assert line["wall_s"] > 0 and line["cpu_s"] is None  # the fake solver keeps no record
    used = {(c["case"], c["check"], c["point"]): c for c in results["checks"]}
    worst = used[tuple(line["worst"][k] for k in ("case", "check", "point"))]
    assert worst["verdict"] == "pass" and 0 < line["worst"]["margin_used"] < 1
    seen = {(o["case"], o["check"], o["point"]): o["measured"] for o in line["observables"]}
    assert seen == {key: c["measured"] for key, c in used.items()}


def test_the_same_run_is_kept_once_and_others_are_added(kept):
    bench, file = kept
    done = history(bench.out, "--file", file)
    assert done.returncode == 0 and "is there already" in done.stdout and len(lines(file)) == 1
    rebuild(bench)
    assert history(bench.out, "--file", file).returncode == 0
    first, second = lines(file)
    assert first["solver_key"] != second["solver_key"]


def test_trends_are_drawn_for_each_tier(kept):
    bench, file = kept
    bench.out = bench.folder / "paper"
    bench.run("fake/steady", "--tier", "paper")
    history(bench.out, "--file", file)
    bench.out = bench.folder / "modified"
    bench.run("fake/steady", "--set", "value=0.0214")
    history(bench.out, "--file", file)
    done = history("--plot", file, "--out", bench.folder / "drawn")
    assert done.returncode == 0, done.stderr
    page = (bench.folder / "drawn" / "index.html").read_text(encoding="utf-8")
    assert "Tier smoke" in page and "Tier paper" in page and "MODIFIED ones are left out" in page
    assert page.count("<svg") == 6  # of smoke: the suite and three cases; of paper: two
    assert "fake/steady" in page and "2 runs of the suite" in page


@pytest.mark.parametrize(
    "text, said",
    [
        ("{}\n", "schema"),
        ('{"schema": "bedcheck-history 1"}\n', "counts"),
        ("junk\n", "line 2"),
        ('{"schema": "bedcheck-history 1"', "line 2 is cut off"),
        ("\n", "line 2"),
    ],
)
def test_a_damaged_file_is_neither_drawn_nor_added_to(kept, text, said):
    bench, file = kept
    with open(file, "a", encoding="utf-8") as out:
        out.write(text)
    before = file.read_bytes()
    rebuild(bench)
    for words in ([bench.out, "--file", file], ["--plot", file, "--out", bench.folder / "drawn"]):
        done = history(*words)
        assert done.returncode == 2 and said in done.stderr, done.stderr
    assert file.read_bytes() == before and not (bench.folder / "drawn").exists()


def test_bad_usage(kept, tmp_path):
    bench, file = kept
    for words in ([], [bench.out], ["--file", file], [bench.out, bench.out, "--file", file],
                  [tmp_path / "none", "--file", file], ["--plot", tmp_path / "none"],
                  [bench.out, "--file", tmp_path / "no" / "folder"]):
        done = history(*words)
        assert done.returncode == 2 and done.stderr, words
    (bench.folder / "empty").write_text("", encoding="utf-8")
    assert history("--plot", bench.folder / "empty").returncode == 2
