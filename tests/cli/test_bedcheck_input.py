"""bedcheck's own input: case files, commands, listings."""

import pytest

from bedcheck_fixtures import CASES, bench  # noqa: F401


def test_list_show_and_recipes_tell_what_there_is(bench):
    done = bench.bedcheck("list", "--cases", CASES)
    assert done.returncode == 0
    assert [line.split()[0] for line in done.stdout.splitlines()] == [
        "fake/heir", "fake/order", "fake/steady"]
    assert "fake/steady" in bench.bedcheck("list", "--cases", CASES, "--tag", "quick").stdout
    assert bench.bedcheck("list", "--cases", CASES, "--tier", "paper").stdout.count("\n") == 1
    shown = bench.bedcheck("show", "fake/steady", "--cases", CASES).stdout
    assert "tier paper: 2 points, 12 runs" in shown and "margin 2 %" in shown
    assert "not another value" in shown and "the value is a third smaller" in shown
    recipes = bench.bedcheck("recipes").stdout
    assert "contacts: " in recipes and "Predictions" in recipes and "order: " in recipes


def test_usage_help_and_version(bench):
    assert bench.bedcheck().returncode == 2
    assert bench.bedcheck("dance").returncode == 2
    assert bench.bedcheck("show").returncode == 2
    assert bench.bedcheck("show", "fake/nobody", "--cases", CASES).returncode == 2
    assert bench.bedcheck("--help").returncode == 0
    assert "--seed-offset" in bench.bedcheck("run", "--help").stdout
    assert bench.bedcheck("--version").stdout.startswith("bedcheck ")


@pytest.mark.parametrize(
    "text, says",
    [
        ("name: fake/x\n  bad: [", "fake/x.yaml:"),
        ("- a list\n", "a case is a map"),
        ("name: &a fake/x\n", "anchors"),
        ("name: !!str fake/x\n", "tags"),
        ("name: fake/x\n---\nname: y\n", "document"),
        ("name: fake/x\nname: fake/x\n", "name"),
        ("a: [[[[[[[[[[1]]]]]]]]]]\n", "deep"),
        pytest.param("# " + "x" * (1 << 20) + "\n", "bytes", id="over a megabyte"),
        ("", "fake/x.yaml"),
        ("name: fake/x\ntitel: y\n", "did you mean 'title'"),
    ],
)
def test_bad_case_files_are_refused_with_their_place(bench, text, says):
    bench.own_case("fake/x", text)
    done = bench.run("fake/x")
    assert done.returncode == 2 and not bench.out.exists()
    assert says in done.stderr


def test_a_case_in_the_wrong_file_or_with_an_unsafe_name(bench):
    bench.own_case("fake/moved", (CASES / "fake/order.yaml").read_text(encoding="utf-8"))
    assert "the file must hold case fake/moved" in bench.run().stderr
    bench.own_case("fake/Bad Name", "name: x\n")
    assert "not a name of a case" in bench.run("fake/*").stderr


def test_a_broken_case_that_is_not_selected_stops_nobody(bench):
    bench.own_case("fake/broken", "name: [\n")
    bench.own_case("fake/order", (CASES / "fake/order.yaml").read_text(encoding="utf-8"))
    assert bench.run("fake/order").returncode == 0
    assert bench.run().returncode == 2


def test_a_missing_folder_of_cases(bench):
    bench.cases = bench.folder / "nowhere"
    done = bench.run()
    assert done.returncode == 2 and "cannot be read" in done.stderr


def test_a_start_stays_inside_the_folder_of_cases(bench):
    bench.own_case("fake/heir", (CASES / "fake/heir.yaml").read_text(encoding="utf-8")
                   .replace("case: fake/steady", "case: ../../fake/steady"))
    assert "is no name of a case" in bench.run().stderr
