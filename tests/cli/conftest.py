"""What every test of the programs shares: where they are, and how to call them."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("BEDCHECK_BIN", ROOT / "build" / "bin"))


def call(program, *arguments, timeout=300, **options):
    """Run a program without standard input; text output, no exception on failure."""
    return subprocess.run(
        [str(program), *map(str, arguments)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
        **options,
    )


@pytest.fixture
def root():
    """The repository's root."""
    return ROOT


@pytest.fixture
def bedsim():
    """bedsim(*arguments) -> CompletedProcess."""
    return lambda *arguments, **options: call(BIN / "bedsim", *arguments, **options)


@pytest.fixture
def bedcheck():
    """bedcheck(*arguments) -> CompletedProcess."""
    return lambda *arguments, **options: call(BIN / "bedcheck", *arguments, **options)
