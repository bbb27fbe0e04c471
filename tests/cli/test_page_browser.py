"""The report's page in a real browser: no error, folding, filtering, links; and its commands.

A browser is driven without any library: a copy of the page gets a second script, whose digest is
added to the page's policy, that does what a reader would and writes what it saw into the title.
"""

import base64
import hashlib
import html
import json
import re
import shlex
import shutil
import subprocess

import pytest

from bedcheck_fixtures import bench  # noqa: F401
from conftest import call

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
needs_browser = pytest.mark.skipif(
    BROWSER is None, reason="no chromium here: the page was not opened (ci/setup --with-pdf)"
)

DRIVER = """
const seen = {};
const errors = [];
addEventListener('error', (event) => errors.push(event.message));
addEventListener('securitypolicyviolation', (event) => errors.push(event.violatedDirective));
const shown = (list) => Array.from(list).filter((e) => e.checkVisibility()).map((e) => e.id || e.dataset.verdict);
const sections = () => shown(document.querySelectorAll('section.case'));
const lines = () => shown(document.querySelectorAll('.matrix tbody tr'));
const choose = (id, value) => {
  const box = document.getElementById(id);
  box.value = value;
  box.dispatchEvent(new Event('input', {bubbles: true}));
};
addEventListener('load', async () => {
  const frame = () => new Promise((done) => setTimeout(done, 50));
  seen.all = sections();
  seen.lines = lines();
  choose('filter-verdict', 'fail');
  seen.fail = sections();
  seen.fail_lines = lines();
  seen.count = document.getElementById('filter-count').textContent;
  const hidden = document.querySelector('section.case[hidden]');
  location.hash = hidden.id;
  await frame();
  seen.linked = hidden.checkVisibility();
  seen.after_link = sections();
  choose('filter-text', 'no such words');
  seen.none = sections();
  choose('filter-text', 'STEADY fake');
  seen.text = sections();
  choose('filter-text', '');
  const button = document.querySelector('section.case .fold');
  const body = document.getElementById(button.getAttribute('aria-controls'));
  button.click();
  seen.folded = [body.checkVisibility(), button.getAttribute('aria-expanded'), button.textContent];
  button.click();
  seen.unfolded = [body.checkVisibility(), button.getAttribute('aria-expanded'), button.textContent];
  document.getElementById('fold-all').click();
  seen.all_folded = shown(document.querySelectorAll('section.case .body'));
  document.getElementById('unfold-all').click();
  seen.copy = document.querySelectorAll('.command button.copy').length;
  seen.wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  seen.headings = Array.from(document.querySelectorAll('h1, h2, h3, h4')).map((e) => Number(e.tagName[1]));
  seen.unnamed = Array.from(document.querySelectorAll('img, svg, input, select, button, [role=region]'))
      .filter((e) => !(e.alt || e.getAttribute('aria-label') || e.getAttribute('aria-labelledby') ||
                       e.closest('label') || e.textContent.trim())).map((e) => e.outerHTML.slice(0, 80));
  seen.errors = errors;
  const result = document.createElement('pre');
  result.id = 'seen';
  result.textContent = JSON.stringify(seen);
  document.body.append(result);
});
"""


def digest(script):
    return "'sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() + "'"


def browse(page, tmp_path, width=1200):
    """What the driver saw, and what the browser wrote on its console."""
    text = page.read_text(encoding="utf-8")
    assert text.count("script-src '") == 1
    text = text.replace("script-src ", "script-src " + digest(DRIVER) + " ")
    text = text.replace("<head>", "<head><script>" + DRIVER + "</script>", 1)
    copy = tmp_path / "driven.html"
    copy.write_text(text, encoding="utf-8")
    done = subprocess.run(
        [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
         f"--user-data-dir={tmp_path / 'profile'}", f"--window-size={width},900",
         "--virtual-time-budget=5000", "--dump-dom", copy.as_uri()],
        capture_output=True, text=True, timeout=300, check=False, stdin=subprocess.DEVNULL,
    )
    found = re.search(r'<pre id="seen">(.*?)</pre>', done.stdout, re.S)
    assert found, done.stderr[-2000:]
    console = [line for line in done.stderr.splitlines() if ":CONSOLE" in line]
    return json.loads(html.unescape(found.group(1))), console


@pytest.fixture
def page(bench):
    """Two cases, one of which fails; the page of both."""
    bench.spoil("fake/steady", *("mode: good}\nsweep: {height_l", "grains: 1}\nsweep: {mode: [good, crash], height_l"))
    text = (bench.cases / "fake" / "steady.yaml").read_text(encoding="utf-8")
    good = text.replace("mode: [good, crash], ", "").replace("grains: 1}", "mode: good}")
    bench.own_case("fake/second", good.replace("fake/steady", "fake/second"))
    assert bench.run("--jobs", "2").returncode == 1
    done = bench.bedcheck("report", bench.out)
    assert done.returncode == 1, done.stdout + done.stderr
    return bench.out / "report" / "index.html"


@needs_browser
def test_the_page_folds_and_filters_without_an_error(page, tmp_path):
    seen, console = browse(page, tmp_path)
    assert seen["errors"] == [] and console == []
    steady, second = "case-fake.steady", "case-fake.second"
    assert sorted(seen["all"]) == sorted([steady, second])
    assert seen["lines"] == ["fail", "pass"]  # what needs a look stands first
    assert seen["fail"] == [steady] and seen["fail_lines"] == ["fail"]
    assert seen["count"] == "1 of 2 cases shown"
    assert seen["linked"] and sorted(seen["after_link"]) == sorted([steady, second])
    assert seen["none"] == [] and seen["text"] == [steady]
    assert seen["folded"] == [False, "false", "Unfold"]
    assert seen["unfolded"] == [True, "true", "Fold"]
    assert seen["all_folded"] == []
    assert seen["copy"] == 2


@needs_browser
def test_a_phone_shows_it_whole_and_a_screen_reader_finds_its_way(page, tmp_path):
    seen, console = browse(page, tmp_path, width=500)
    assert console == []
    assert seen["wide"] <= 0  # tables and figures scroll, the page does not
    assert seen["unnamed"] == []
    levels = seen["headings"]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(b <= a + 1 for a, b in zip(levels, levels[1:]))


def test_the_command_to_copy_works_in_any_folder(bench, page, tmp_path):
    text = page.read_text(encoding="utf-8")
    blocks = re.findall(r'<div class="command">.*?<code>(.*?)</code>', text, re.S)
    line = next(html.unescape(b) for b in blocks if "fake/second" in b)
    elsewhere = tmp_path / "else where"
    elsewhere.mkdir()
    done = call(*shlex.split(line), cwd=elsewhere)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "fake/second" in done.stdout and "fake/steady" not in done.stdout
