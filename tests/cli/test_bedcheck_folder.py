"""The folder of results: check, report, clean, and whose folder it is."""

import os
import subprocess
import time

import pytest

from bedcheck_fixtures import bench  # noqa: F401
from conftest import BIN


def test_check_judges_again_without_running(bench):
    bench.run("fake/*")
    bench.calls()
    before = bench.results()["checks"]
    (bench.out / "results.json").unlink()
    done = bench.bedcheck("check", bench.out)
    assert done.returncode == 0, done.stdout + done.stderr
    assert bench.calls() == [] and bench.results()["checks"] == before


def test_report_writes_the_page_again(bench):
    bench.run("fake/order", "--set", "slope=3e-4", "--skip", "fake/none=x")
    bench.run("fake/order", "--set", "slope=3e-4")
    page = bench.out / "report" / "index.html"
    page.unlink()
    done = bench.bedcheck("report", bench.out)
    assert done.returncode == 0 and "MODIFIED" in page.read_text(encoding="utf-8")


def test_another_expectation_turns_check_red(bench):
    bench.spoil("fake/steady", "margin: 2 %", "margin: 2 %")
    bench.run()
    bench.spoil("fake/steady", "expect: 0.0213", "expect: 0.0223")
    assert bench.bedcheck("check", bench.out).returncode == 1


def test_results_of_two_builds_are_refused(bench):
    bench.run("fake/order")
    bench.build_solver("second build")
    bench.run("fake/steady")
    for command in ("check", "report"):
        done = bench.bedcheck(command, bench.out)
        assert done.returncode == 2 and "2 different solver builds" in done.stderr
    assert bench.bedcheck("clean", "--stale", bench.out).returncode == 0
    assert bench.bedcheck("check", bench.out).returncode == 0


def test_missing_and_exchanged_runs_are_refused(bench):
    bench.run("fake/order")
    first, second = sorted((bench.out / "h5").glob("*.h5"))[:2]
    kept = first.read_bytes()
    first.unlink()
    done = bench.bedcheck("check", bench.out)
    assert done.returncode == 2 and "1 of 4 runs are missing" in done.stderr
    first.write_bytes(kept)
    key = first.with_suffix(".key")
    key.write_bytes(second.with_suffix(".key").read_bytes())
    assert bench.bedcheck("check", bench.out).returncode == 2


def test_a_flipped_byte_in_a_record_is_refused(bench):
    bench.run("fake/order")
    record = bench.out / "bedcheck.yaml"
    text = record.read_text(encoding="utf-8")
    record.write_text(text.replace("seed_offset: 0", "seed_offset: x"), encoding="utf-8")
    assert "seed_offset" in bench.bedcheck("check", bench.out).stderr
    record.write_text(text.replace("fake/order", "../order"), encoding="utf-8")
    assert bench.bedcheck("check", bench.out).returncode == 2


@pytest.mark.parametrize("command", ["check", "report", "clean"])
def test_foreign_folders_are_left_alone(bench, command):
    foreign = bench.folder / "letters"
    foreign.mkdir()
    (foreign / "results.json").write_text("{}", encoding="utf-8")
    done = bench.bedcheck(command, foreign)
    assert done.returncode == 2 and "no folder of bedcheck's results" in done.stderr
    assert [p.name for p in foreign.iterdir()] == ["results.json"]
    assert bench.bedcheck(command, bench.folder / "nowhere").returncode == 2
    assert bench.bedcheck(command).returncode == 2


def test_run_refuses_a_foreign_folder_and_takes_an_empty_one(bench):
    bench.out.mkdir()
    (bench.out / "thesis.txt").write_text("mine", encoding="utf-8")
    done = bench.run("fake/order")
    assert done.returncode == 2 and [p.name for p in bench.out.iterdir()] == ["thesis.txt"]
    assert bench.run("fake/order", "--dry-run").returncode == 2
    (bench.out / "thesis.txt").unlink()
    assert bench.run("fake/order").returncode == 0


def test_clean_removes_ours_and_leaves_the_rest(bench):
    bench.run("fake/*")
    (bench.out / "h5" / "notes.txt").write_text("mine", encoding="utf-8")
    (bench.out / "h5" / "mine.h5").write_text("mine", encoding="utf-8")
    (bench.folder / "elsewhere").mkdir()
    (bench.folder / "elsewhere" / "a.log").write_text("mine", encoding="utf-8")
    os.symlink(bench.folder / "elsewhere", bench.out / "more")
    done = bench.bedcheck("clean", bench.out)
    assert done.returncode == 0 and "not bedcheck's" in done.stdout
    left = sorted(str(p.relative_to(bench.out)) for p in bench.out.rglob("*"))
    assert left == ["h5", "h5/mine.h5", "h5/notes.txt", "more"]
    assert (bench.folder / "elsewhere" / "a.log").exists()


def test_clean_removes_a_folder_that_held_nothing_else(bench):
    bench.run("fake/order")
    assert bench.bedcheck("clean", bench.out).returncode == 0
    assert not bench.out.exists()


def test_one_bedcheck_at_a_time(bench):
    bench.run("fake/order")
    words = [BIN / "bedcheck", "run", "fake/order", "--cases", bench.cases, "--out", bench.out,
             "--solver", bench.solver, "--set", "sleep=3"]
    with subprocess.Popen([str(w) for w in words], stdout=subprocess.DEVNULL) as process:
        while (bench.out / "results.json").exists() and process.poll() is None:
            time.sleep(0.02)  # it goes once the folder is taken
        done = bench.bedcheck("check", bench.out)
        assert done.returncode == 2 and "another bedcheck works" in done.stderr
        process.terminate()


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_an_output_folder_that_cannot_be_written(bench):
    bench.folder.chmod(0o555)
    done = bench.run("fake/order")
    bench.folder.chmod(0o755)
    assert done.returncode == 2 and str(bench.out) in done.stderr


def test_an_output_that_is_no_folder_or_cannot_be_made(bench):
    bench.out.write_text("a file", encoding="utf-8")
    assert bench.run("fake/order").returncode == 2
    assert bench.out.read_text(encoding="utf-8") == "a file"
    bench.out = bench.out / "inside"
    assert bench.run("fake/order").returncode == 2
    bench.out = "/proc/no-such/out"
    assert bench.run("fake/order").returncode == 2


def test_no_room_is_told_before_the_first_run(bench):
    bench.spoil("fake/order", "observables: {bed: {recipe: contacts}}",
                "also_write: [particles/grains/position]\nobservables: {bed: {recipe: contacts}}")
    text = (bench.cases / "fake/order.yaml").read_text(encoding="utf-8")
    bench.own_case("fake/order", text.replace("{value: 0,", "{value: 0, grains: 9e15,"))
    done = bench.run()
    assert done.returncode == 2 and not bench.out.exists() and bench.calls() == []
