"""bedcheck run: verdicts, exit codes, reuse, seeds, starts, dry runs, choices."""

import json
import math
import xml.etree.ElementTree

import pytest

from bedcheck_fixtures import bench  # noqa: F401


def test_right_data_pass_and_every_report_is_written(bench):
    done = bench.run("fake/*")
    assert done.returncode == 0, done.stdout + done.stderr
    last = done.stdout.splitlines()[-1]
    assert last.startswith("PASS: 8 checks: 8 pass, 0 fail") and "report/index.html" in last
    assert (bench.out / "report" / "index.html").stat().st_size > 1000
    assert (bench.out / "summary.md").exists()
    xml.etree.ElementTree.parse(bench.out / "junit.xml")
    check = bench.results()["checks"][0]
    assert set(check) >= {"case", "point", "check", "observable", "unit", "measured", "uncertainty",
                          "expected", "expected_uncertainty", "tolerance", "kind", "verdict",
                          "because", "runs"}


def test_numbers_are_those_of_the_data(bench):
    assert bench.run("fake/order").returncode == 0
    check = bench.results()["checks"][0]
    assert math.isclose(check["measured"], 2, abs_tol=1e-9)
    assert check["expected"] == 2 and check["tolerance"] == 0.01 and len(check["runs"]) == 4


@pytest.mark.parametrize(
    "setting, red",
    [
        ("value=0.0224", "overlap"),  # 5 % off, margin 2 %
        ("value=0.0201", "overlap"),
        ("value=0.0313", "not another value"),
        ("value=1.9", "solid fraction"),
    ],
)
def test_wrong_data_fail_and_the_report_is_marked(bench, setting, red):
    done = bench.run("fake/steady", "--set", setting)
    assert done.returncode == 1
    assert done.stdout.splitlines()[-1].startswith(f"MODIFIED ({setting}) FAIL")
    failed = {key[2] for key, verdict in bench.verdicts().items() if verdict == "fail"}
    assert red in failed
    assert "expected" in done.stdout and "repeat: " in done.stdout and f"--set {setting}" in done.stdout
    assert "MODIFIED" in (bench.out / "report" / "index.html").read_text(encoding="utf-8")


def test_what_repeats_several_rows_is_told_once(bench):
    done = bench.run("fake/steady", "--set", "value=1.9")
    commands = [line for line in done.stdout.splitlines() if "repeat: " in line]
    failed = [key for key, verdict in bench.verdicts().items() if verdict != "pass"]
    assert len(commands) == len(set(commands)) == len({point for _, point, _ in failed}) < len(failed)


def test_the_wrong_order_fails(bench):
    bench.spoil("fake/order", "expect: 2\n", "expect: 1\n")
    assert bench.run().returncode == 1


def test_too_much_scatter_is_inconclusive(bench):
    done = bench.run("fake/steady", "--set", "noise=3e-4")
    assert done.returncode == 3, done.stdout
    assert done.stdout.splitlines()[-1].startswith("MODIFIED (noise=3e-4) INCONCLUSIVE")


def test_seeds_that_do_not_matter_are_noticed(bench):
    done = bench.run("fake/steady", "--set", "noise=0")
    assert done.returncode == 3
    assert "last bit" in done.stdout


def test_a_second_run_reuses_everything(bench):
    bench.run("fake/steady")
    assert len(bench.calls()) == 8
    first = bench.results()["checks"]
    done = bench.run("fake/steady")
    assert done.returncode == 0 and bench.calls() == []
    assert bench.results()["checks"] == first


def test_a_rebuilt_solver_a_setting_and_fresh_seeds_run_again(bench):
    bench.run("fake/steady")
    bench.calls()
    bench.build_solver("second build")
    bench.run("fake/steady")
    assert len(bench.calls()) == 8
    bench.run("fake/steady", "--set", "sleep=0")
    assert len(bench.calls()) == 8
    bench.run("fake/steady")
    assert len(bench.calls()) == 8
    bench.run("fake/steady", "--seed-offset", "5000")
    names = bench.calls()
    assert len(names) == 8 and any(name.endswith("-s6104.h5") for name in names)


def test_a_changed_parameter_runs_again_and_a_changed_expectation_does_not(bench):
    bench.spoil("fake/steady", "margin: 2 %", "margin: 2 %")
    bench.run()
    bench.calls()
    bench.spoil("fake/steady", "expect: 0.0213", "expect: 0.0223")
    assert bench.run().returncode == 1
    assert bench.calls() == []
    bench.spoil("fake/steady", "value: 0.0213", "value: 0.0214")
    bench.run()
    assert len(bench.calls()) == 8


def test_a_result_of_another_size_is_not_trusted(bench):
    bench.run("fake/order")
    bench.calls()
    victim = sorted((bench.out / "h5").glob("*.h5"))[0]
    victim.write_bytes(victim.read_bytes()[:-1])
    assert bench.run("fake/order").returncode == 0
    assert bench.calls() == [victim.name]


def test_a_start_is_made_first_shared_and_followed(bench):
    done = bench.run("fake/heir")
    assert done.returncode == 0, done.stdout + done.stderr
    names = bench.calls()
    assert len(names) == 4
    for seed in (1101, 1102):
        ours = [n for n in names if n.endswith(f"-s{seed}.h5")]
        assert [n.split(".")[1] for n in ours] == ["steady", "heir"]
    bench.run("fake/steady")
    assert len(bench.calls()) == 6  # two of eight are there
    victim = next((bench.out / "h5").glob("fake.steady.*-s1101.h5.never"), None)
    assert victim is None
    for path in (bench.out / "h5").glob("fake.steady.*-s1101.*"):
        path.unlink()
    bench.run("fake/heir")
    again = bench.calls()  # the same bytes come back: the heir keeps its key
    assert [n.split(".")[1] for n in again] == ["steady"]


def test_a_dry_run_tells_and_does_nothing(bench):
    done = bench.run("fake/*", "--dry-run")
    assert done.returncode == 0 and not bench.out.exists() and bench.calls() == []
    assert "14 runs: 0 reused, 14 to make" in done.stdout and " MB" in done.stdout
    assert " min with " in done.stdout and "starts from fake.steady." in done.stdout
    bench.run("fake/order")
    done = bench.run("fake/*", "--dry-run")
    assert "14 runs: 4 reused, 10 to make" in done.stdout


def test_globs_tags_tiers_and_skips_choose(bench):
    assert "6 checks" in bench.run("fake/st*").stdout
    assert "6 checks" in bench.run("--tag", "scattered").stdout
    bench.calls()
    assert bench.run("fake/*", "--tier", "paper").returncode == 0  # of one case only
    assert len(bench.calls()) == 4  # two points, two fresh seeds
    done = bench.run("fake/*", "--skip", "fake/order=its paper is lost")
    assert done.returncode == 0
    assert "7 pass" in done.stdout and "1 skipped" in done.stdout
    assert "its paper is lost" in (bench.out / "junit.xml").read_text(encoding="utf-8")
    assert "its paper is lost" in (bench.out / "report/index.html").read_text(encoding="utf-8")
    counts = json.dumps(bench.results())
    assert "fake/order" in counts


@pytest.mark.parametrize(
    "words, says",
    [
        (["fake/stedy"], "did you mean fake/steady?"),
        (["steady"], "no such case"),
        (["nothing/*"], "no such case"),
        (["--tag", "nobody"], "nothing selected"),
        (["fake/order", "--tier", "paper"], "has no tier paper"),
        (["--tier", "large"], "nothing selected"),
        (["--tier", "papr"], "no such tier"),
        (["fake/order", "--skip", "fake/order=why"], "every case is skipped"),
        (["fake/order", "--skip", "fake/steady=why"], "no selected case has this name"),
        (["fake/order", "--skip", "fake/order"], "must be CASE=reason"),
        (["fake/order", "--skip", "fake/order= "], "must be CASE=reason"),
        (["--jobs", "0"], "--jobs 0"),
        (["--jobs", "two"], "--jobs two"),
        (["--timeout", "-1"], "--timeout -1"),
        (["--seed-offset", "1.5"], "--seed-offset 1.5"),
        (["--set", "value"], "must be parameter=value"),
        (["--set", "=3"], "must be parameter=value"),
        (["--failed", "fake/order"], "--failed chooses the cases"),
        (["--failed"], "no such folder"),
        (["--no-such-option"], "unrecognized option"),
    ],
)
def test_what_cannot_be_done_is_exit_code_2(bench, words, says):
    done = bench.run(*words)
    assert done.returncode == 2, done.stdout
    assert says in done.stderr
    assert not bench.out.exists() and bench.calls() == []


def test_failed_runs_what_did_not_pass(bench):
    bench.run("fake/*", "--set", "value=0.02")
    assert bench.verdicts()[("fake/steady", "height_l=3.7", "overlap")] == "fail"
    bench.calls()
    done = bench.run("--failed")
    assert done.returncode == 0, done.stdout + done.stderr
    assert {n.split(".")[1] for n in bench.calls()} == {"heir", "order", "steady"}
    done = bench.run("--failed")
    assert done.returncode == 2 and "every check" in done.stderr
    assert bench.run("--failed", "--tier", "paper").returncode == 2


def test_exitfirst_starts_no_more(bench):
    bench.run("fake/*", "-x", "--jobs", "1", "--set", "slope=0.9")
    names = bench.calls()
    assert {n.split(".")[1] for n in names} <= {"heir", "steady", "order"}
    done = bench.run("fake/*", "-x", "--jobs", "1", "--set", "value=0.5")
    assert done.returncode == 1
    assert {n.split(".")[1] for n in bench.calls()} == {"steady", "heir"}
    assert "stopped at the first failure" in (bench.out / "summary.md").read_text(encoding="utf-8")


def test_equal_points_share_a_run(bench):
    text = (bench.cases / "fake/steady.yaml").read_text(encoding="utf-8")
    bench.own_case("fake/steady", text.replace("seeds: {first: 1101, count: 4}",
                                               "seeds: {first: 1101, count: 2}"))
    bench.run()
    assert len(set(bench.calls())) == 4
