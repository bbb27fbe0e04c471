"""ci/setup: lists, installs and stays quiet, seen with a package manager of paper."""

import os
import stat
import subprocess

import pytest


@pytest.fixture
def setup(root, tmp_path):
    """setup(missing, *arguments) -> (CompletedProcess, what apt-get was asked)."""

    def script(name, text):
        path = tmp_path / name
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def call(missing, *arguments):
        log = tmp_path / "apt.log"
        log.write_text("")
        cases = "".join(f"*' {name}') exit 1;; " for name in missing)
        script("dpkg-query", f"case \"$*\" in {cases}*) printf 'ii ';; esac\n")
        script("apt-get", f'echo "$@" >> "{log}"\n')
        script("sudo", 'exec "$@"\n')
        done = subprocess.run(
            [str(root / "ci" / "setup"), *arguments],
            env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )
        return done, log.read_text().splitlines()

    return call


def test_nothing_missing_is_quiet(setup):
    for arguments in ([], ["--check"]):
        done, asked = setup([], *arguments)
        assert (done.returncode, done.stdout, done.stderr, asked) == (0, "", "", [])


def test_check_only_lists(setup):
    done, asked = setup(["tidy", "libgsl-dev"], "--check")
    assert (done.returncode, done.stdout, asked) == (1, "missing: libgsl-dev tidy\n", [])


def test_missing_packages_are_named_and_installed(setup):
    done, asked = setup(["tidy"])
    assert done.returncode == 0
    assert "ci/setup: installing tidy\n" in done.stdout
    assert [line for line in asked if "tidy" in line] == asked[1:]
    assert "update" in asked[0] and "--no-install-recommends tidy" in asked[1]


def test_pdf_is_asked_for(setup):
    assert setup(["chromium"], "--check")[0].returncode == 0
    assert setup(["chromium"], "--with-pdf", "--check")[0].stdout == "missing: chromium\n"


def test_an_unknown_option_is_refused(setup):
    done, asked = setup(["tidy"], "--chek")
    assert done.returncode == 2 and "--chek" in done.stderr and asked == []
