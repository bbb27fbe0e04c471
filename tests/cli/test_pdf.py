"""ci/pdf: the page printed where there is a program for it; a broken PDF is a fault, a missing program is not."""

import os
import shutil
import stat
import subprocess

import pytest

PRINTER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "weasyprint"))), None)
TOOLS = "bash env dirname mktemp rm mv head tail grep stat timeout od tr cat printf sed".split()


@pytest.fixture
def folder(tmp_path):
    """A folder of results with a page, and a PDF of another page."""
    report = tmp_path / "re sults #1" / "report"
    report.mkdir(parents=True)
    (report / "index.html").write_text(
        "<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>FAIL: x</title></head>"
        "<body><h1>Fail, 17.3 % of it</h1></body></html>"
    )
    (report / "report.pdf").write_bytes(b"%PDF-1.4 of before %%EOF")
    return report.parent


def pdf(root, folder, path=None):
    return subprocess.run(
        [str(root / "ci" / "pdf"), str(folder)],
        env={**os.environ, "PATH": path or os.environ["PATH"]},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


@pytest.fixture
def printer(tmp_path):
    """printer(shell) -> PATH on which the only printer is that shell script; none for None."""

    def make(shell):
        tools = tmp_path / "bin"
        tools.mkdir()
        for tool in TOOLS:
            if shutil.which(tool):
                (tools / tool).symlink_to(shutil.which(tool))
        if shell is not None:
            fake = tools / "weasyprint"
            fake.write_text("#!/bin/sh\n" + shell)
            fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
        return str(tools)

    return make


def test_no_program_is_one_line_and_no_fault(root, folder, printer):
    done = pdf(root, folder, printer(None))
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("no report.pdf: ") and done.stdout.count("\n") == 1
    assert "ci/setup --with-pdf" in done.stdout
    assert not (folder / "report" / "report.pdf").exists(), "the PDF of before shows another page"


@pytest.mark.parametrize(
    "shell", ["exit 3\n", "printf 'Traceback' > \"$3\"\n", "printf '%%PDF-1.7 cut' > \"$3\"\n", "true\n"]
)
def test_a_broken_pdf_is_a_fault(root, folder, printer, shell):
    done = pdf(root, folder, printer(shell))
    assert done.returncode == 2 and "weasyprint" in done.stderr
    assert not (folder / "report" / "report.pdf").exists()


def test_a_whole_one_is_kept(root, folder, printer):
    done = pdf(root, folder, printer("printf '%%PDF-1.7\\n%%%%EOF\\n' > \"$3\"\n"))
    assert done.returncode == 0, done.stderr
    assert (folder / "report" / "report.pdf").read_bytes() == b"%PDF-1.7\n%%EOF\n"


def test_weasyprint_sees_no_colour_that_it_stops_at(root, folder, printer):
    page = folder / "report" / "index.html"
    page.write_text("<svg color='#000'><path id='a' stroke='currentColor'/></svg>")
    done = pdf(root, folder, printer("! grep currentColor \"$2\" && printf '%%PDF-1.7\\n%%%%EOF\\n' > \"$3\"\n"))
    assert done.returncode == 0, done.stderr
    assert "currentColor" in page.read_text()


def test_a_folder_without_a_page(root, tmp_path):
    done = pdf(root, tmp_path)
    assert done.returncode == 2 and "no such page" in done.stderr


@pytest.mark.skipif(PRINTER is None, reason="neither chromium nor weasyprint here: no PDF was made (ci/setup --with-pdf)")
def test_the_page_as_it_is(root, folder):
    done = pdf(root, folder)
    assert done.returncode == 0, done.stderr
    bytes_ = (folder / "report" / "report.pdf").read_bytes()
    assert bytes_.startswith(b"%PDF-") and b"%%EOF" in bytes_[-64:]
    if shutil.which("pdftotext"):
        text = subprocess.run(["pdftotext", folder / "report" / "report.pdf", "-"], capture_output=True, text=True, check=True)
        assert "Fail, 17.3 % of it" in text.stdout
