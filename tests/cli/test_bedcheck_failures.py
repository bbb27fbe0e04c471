"""Solvers that crash, hang, refuse or write nonsense: each a verdict that says how."""

import os
import signal
import subprocess
import time

import pytest

from bedcheck_fixtures import bench  # noqa: F401
from conftest import BIN


def good_and(mode):
    """The steady case, one point of which has this mode."""
    return "mode: good}\nsweep: {height_l", f"grains: 1}}\nsweep: {{mode: [good, {mode}], height_l"


@pytest.mark.parametrize(
    "mode, says",
    [
        ("crash", "SIGSEGV"),
        ("numerical", "numerical fault (exit code 1)"),
        ("odd", "exit code 9"),
        ("nothing", "wrote no result file"),
        ("empty", "wrote no result file"),
        ("nan", "the result cannot be used"),
        ("shape", "the result cannot be used"),
        ("missing", "sweeps_max"),
        ("short", "the result cannot be used"),
        ("text", "the result cannot be used"),
    ],
)
def test_a_bad_run_is_a_failed_check_that_says_how(bench, mode, says):
    bench.spoil("fake/steady", *good_and(mode))
    done = bench.run("--jobs", "2")
    assert done.returncode == 1, done.stdout + done.stderr
    assert says in done.stdout
    verdicts = bench.verdicts()
    for (case, point, check), verdict in verdicts.items():
        if "mode=good" in point:
            assert verdict == "pass"
        else:
            assert verdict == ("fail" if check.startswith("run with seed") else "inconclusive")
    assert sum(check.startswith("run with seed") for _, _, check in verdicts) == 8
    assert "repeat: " in done.stdout
    for check in bench.results()["checks"]:
        if check["verdict"] == "inconclusive":
            assert check["measured"] is None


def test_the_log_s_end_is_shown_and_the_command_repeats_the_run(bench):
    bench.spoil("fake/steady", *good_and("numerical"))
    done = bench.run()
    assert "log: fake solver: step 17: not converged" in done.stdout
    command = next(line for line in done.stdout.splitlines() if "repeat: " in line)
    again = subprocess.run(command.split("repeat: ")[1], shell=True, cwd=bench.folder, check=False,
                           capture_output=True, text=True)
    assert again.returncode == 1 and "not converged" in again.stderr


def test_failed_runs_are_tried_again_and_shown_by_check(bench):
    bench.spoil("fake/steady", *good_and("numerical"))
    bench.run()
    assert len(bench.calls()) == 16
    again = bench.bedcheck("check", bench.out)
    assert again.returncode == 1 and "numerical fault" in again.stdout
    bench.run()
    assert len(bench.calls()) == 8


def test_a_run_beyond_its_limit_times_out(bench):
    bench.spoil("fake/order", "value: 0,", "value: 0, mode: hang,")
    begun = time.monotonic()
    done = bench.run("--timeout", "0.7", "--jobs", "4")
    assert done.returncode == 1 and "timed out after" in done.stdout and "limit 0.7 s" in done.stdout
    assert time.monotonic() - begun < 20


def test_the_case_s_limit_counts(bench):
    bench.spoil("fake/order", "limit_s: 60", "limit_s: 3")
    bench.own_case("fake/order", (bench.cases / "fake/order.yaml").read_text(encoding="utf-8")
                   .replace("[3, 6, 12, 24]", "[3, 6]").replace("value: 0,", "value: 0, mode: hang,"))
    assert "limit 3 s" in bench.run("--jobs", "2").stdout


def test_refused_input_stops_everything(bench):
    bench.spoil("fake/steady", *good_and("refuse"))
    done = bench.run("--jobs", "1")
    assert done.returncode == 2
    assert "RUN.yaml:9: mode: refused" in done.stderr and "repeat with: " in done.stderr
    assert not (bench.out / "results.json").exists()


def test_a_failed_start_fails_its_heirs(bench):
    done = bench.run("fake/heir", "--set", "mode=numerical")
    assert done.returncode == 1
    assert "the run that it starts from, fake.steady." in done.stdout


def test_an_interrupt_keeps_what_is_complete(bench):
    words = [BIN / "bedcheck", "run", "fake/steady", "--cases", bench.cases, "--out", bench.out,
             "--solver", bench.solver, "--jobs", "2", "--set", "sleep=0.8"]
    with subprocess.Popen([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, env=dict(os.environ, FAKE_LOG=str(bench.log))) as process:
        deadline = time.monotonic() + 30
        while len(list(bench.out.glob("h5/*.key"))) < 2 and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "are complete and kept" in errors
    kept = len(list(bench.out.glob("h5/*.key")))
    assert 2 <= kept < 8 and len(list(bench.out.glob("h5/*.h5"))) == kept
    assert not (bench.out / "results.json").exists()
    bench.calls()
    done = bench.run("fake/steady", "--set", "sleep=0.8")
    assert done.returncode == 0 and len(bench.calls()) == 8 - kept


def test_an_unusable_solver_is_bedcheck_s_own_trouble(bench):
    bench.solver.chmod(0o644)
    done = bench.run("fake/order")
    assert done.returncode == 2 and "no such program" in done.stderr and not bench.out.exists()
    bench.solver.unlink()
    assert bench.run("fake/order").returncode == 2
    bench.solver = "python3 solver.py"
    assert "one program without arguments" in bench.run("fake/order").stderr


def test_a_solver_that_changes_meanwhile_is_noticed(bench):
    bench.solver.write_text(bench.solver.read_text(encoding="utf-8")
                            .replace("exec", f'echo "# more" >> "{bench.solver}"\nexec'),
                            encoding="utf-8")
    done = bench.run("fake/order")
    assert done.returncode == 2 and "changed during the runs" in done.stderr
