"""Files for CI servers: templates, the schema of results.json, junit.xml."""

import copy
import json
import re
import xml.etree.ElementTree

import jsonschema
import pytest
import yaml

from bedcheck_fixtures import bench  # noqa: F401
from conftest import ROOT, call

TEMPLATES = sorted((ROOT / "ci" / "templates").glob("*.yml"))


def commands(node):
    """Every shell line of a template: what stands under run and script."""
    if isinstance(node, list):
        for item in node:
            yield from commands(item)
    elif isinstance(node, dict):
        for key, value in node.items():
            if key in ("run", "script", "before_script", "after_script"):
                yield from value if isinstance(value, list) else [value]
            else:
                yield from commands(value)


@pytest.mark.parametrize("path", TEMPLATES, ids=lambda p: p.name)
def test_templates_call_nothing_but_our_scripts(path):
    found = list(commands(yaml.safe_load(path.read_text(encoding="utf-8"))))
    assert any(line.startswith("ci/test") for line in found)
    assert any(line.startswith("ci/validate") for line in found)
    for line in found:  # GitHub has no other way to show a summary
        assert re.match(r"ci/(test|validate)\b|cat \S+/summary.md >> \"\$GITHUB_STEP_SUMMARY\"$", line), line


def test_there_is_a_template_for_each_server():
    assert [p.name for p in TEMPLATES] == ["github-actions.yml", "gitlab-ci.yml"]


@pytest.fixture(scope="module")
def schema():
    loaded = json.loads((ROOT / "docs" / "results.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(loaded)
    return loaded


def strict(schema):
    """The schema without room for members that it does not name."""
    closed = copy.deepcopy(schema)
    for part in (closed, closed["$defs"]["check"], closed["properties"]["counts"]):
        part["additionalProperties"] = False
    return jsonschema.Draft202012Validator(closed)


def test_results_fit_the_schema_and_have_no_other_members(bench, schema):
    bench.run("fake/*", "--skip", "fake/order=no time")
    strict(schema).validate(bench.results())
    bench.run("fake/steady", "--set", "mode=crash")
    results = bench.results()
    strict(schema).validate(results)
    assert any(c["measured"] is None for c in results["checks"])


@pytest.mark.parametrize(
    "spoil",
    [
        lambda r: r.pop("tier"),
        lambda r: r.update(schema="bedcheck-results 2"),
        lambda r: r["checks"][0].pop("seeds"),
        lambda r: r["checks"][0].update(verdict="PASS"),
        lambda r: r["checks"][0].update(measured=None, verdict="pass"),
        lambda r: r["checks"][0].update(uncertainty=-1e-3),
        lambda r: r["counts"].update(fail=-1),
    ],
)
def test_the_schema_refuses_what_is_none(bench, schema, spoil):
    bench.run("fake/heir")
    results = bench.results()
    jsonschema.Draft202012Validator(schema).validate(results)
    spoil(results)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft202012Validator(schema).validate(results)


def test_junit_names_are_unique_and_times_decimal(bench):
    bench.run("fake/*", "--set", "value=0.0271")
    root = xml.etree.ElementTree.parse(bench.out / "junit.xml").getroot()
    tests = list(root.iter("testcase"))
    names = [(t.get("classname"), t.get("name")) for t in tests]
    assert len(names) == len(set(names)) == len(bench.results()["checks"])
    assert all(re.fullmatch(r"\d+\.\d+", t.get("time")) for t in tests)
    failed = [t.find("failure") for t in tests if t.find("failure") is not None]
    assert failed
    for failure in failed:
        assert re.search(r"measured  -?\d.*\nexpected  -?\d.*\naccepted  ", failure.text), failure.text
    assert len((bench.out / "summary.md").read_bytes()) < 1024 * 1024


@pytest.mark.parametrize("script", ["compare-commits", "configurations"])
def test_scripts_refuse_what_they_cannot_use(script, tmp_path):
    done = call(ROOT / "ci" / script, tmp_path / "none")
    assert done.returncode == 2 and f"ci/{script}: " in done.stderr


def test_compare_commits_refuses_unknown_commits(tmp_path):
    done = call(ROOT / "ci" / "compare-commits", "HEAD", "no-such-commit", "--frob")
    assert done.returncode == 2 and "unknown option" in done.stderr
    done = call(ROOT / "ci" / "compare-commits", "no-such-commit", "HEAD")
    assert done.returncode == 2 and "no-such-commit: no such commit here" in done.stderr
