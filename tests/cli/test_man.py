"""Manual pages and completion say what the programs' own --help says; what is installed works."""

import os
import re
import shutil
import subprocess

import pytest

from conftest import BIN, ROOT, call

MAN = ROOT / "docs" / "man"
COMPLETION = ROOT / "docs" / "completion"
COMMANDS = ["list", "show", "recipes", "claims", "run", "check", "report", "calibrate", "accept",
            "clean", "compare", "history"]
BEDSIM = ["run", "models", "params", "datasets", "xdmf"]
OPTION = re.compile(r"^ {2,6}(?:-\S, )?\s*(--[a-z-]+)(=\S+)?", re.M)


def helped(program, *words):
    done = call(BIN / program, *words, "--help")
    assert done.returncode == 0, done.stderr
    return done.stdout


def options(program, command):
    """{'--out': '=DIR', ...} as --help tells them, but for --help itself and --usage."""
    found = {name: argument for name, argument in OPTION.findall(helped(program, command))}
    assert found.pop("--help") == "" and found.pop("--usage") == ""
    return found


def page(program):
    """{head of a section below COMMANDS: its text}, with roff's escapes taken out."""
    text = (MAN / f"{program}.1").read_text(encoding="utf-8")
    text = re.sub(r"\\f[A-Z]", "", text).replace("\\-", "-").replace("\\ ", " ")
    commands = re.split(r"^\.SH ", text, flags=re.M)
    commands = next(part for part in commands if part.startswith("COMMANDS"))
    parts = re.split(r"^\.SS ", commands, flags=re.M)[1:]
    return {part.split("\n")[0]: part for part in parts}


def documented(text):
    """{'--out': '=DIR', ...} of a section's .TP heads, whatever macro sets them."""
    heads = re.findall(r"^\.TP\n(?:\.[BIR]+ )?(.*)$", text, flags=re.M)
    found = {}
    for head in heads:
        name, argument = re.search(r"(--[a-z-]+)(?:= ?(\S+))?", head).groups()
        found[name] = f"={argument}" if argument else ""
    return found


# -- manual pages ----------------------------------------------------------------------


def test_bedcheck_1_has_every_command_with_its_arguments_and_doc():
    lines = [re.match(r"  (\w.{8}) (.{16}) (.*)$", line) for line in helped("bedcheck").splitlines()]
    told = {f"{m[1].strip()} {m[2].strip()}".strip(): m[3] for m in lines if m}
    assert [head.split()[0] for head in told] == COMMANDS
    sections = page("bedcheck")
    assert list(sections) == list(told)
    for head, doc in told.items():
        assert doc in sections[head], head


@pytest.mark.parametrize("program, command", [("bedcheck", c) for c in COMMANDS] + [("bedsim", "run")])
def test_the_page_has_the_options_of_the_program_and_no_other(program, command):
    section = next(text for head, text in page(program).items() if head.split()[0] == command)
    assert documented(section) == options(program, command)


def test_bedsim_1_has_every_command():
    assert re.findall(r"bedsim ([a-z]+)", helped("bedsim")) == BEDSIM
    assert list(page("bedsim")) == BEDSIM


@pytest.mark.parametrize("name", ["bedsim", "bedcheck"])
@pytest.mark.parametrize("words", [("man", "--warnings", "-l", "-Tutf8"), ("mandoc", "-Tlint")])
def test_pages_are_clean(name, words):
    if shutil.which(words[0]) is None:
        pytest.skip(f"{words[0]} is not installed: ci/setup")
    done = subprocess.run([*words, MAN / f"{name}.1"], stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, check=False, env={**os.environ, "LC_ALL": "C.UTF-8"})
    complaints = done.stderr if words[0] == "man" else done.stdout
    complaints = [c for c in complaints.splitlines() if "STYLE" not in c]
    assert done.returncode == 0 or words[0] == "mandoc"
    assert complaints == []


# -- completion --------------------------------------------------------------------------


def complete(line):
    """What bash offers for the last word of a line: its words are split as readline does."""
    words = re.findall(r"=|[^\s=]+", line) + ([""] if line.endswith(" ") else [])
    current = "" if words[-1] == "=" else words[-1]
    script = (f'source "{COMPLETION}/bedcheck.bash"\nCOMP_WORDS=("$@")\n'
              f'COMP_CWORD=$(($# - 1))\n_bedcheck "$1" "{current}" "${{COMP_WORDS[COMP_CWORD-1]}}"\n'
              'printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "-c", script, "bash", *words], capture_output=True, text=True,
                          check=True, cwd=ROOT, stdin=subprocess.DEVNULL,
                          env={**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"})
    assert done.stderr == ""
    return done.stdout.split()


def test_bash_offers_the_commands():
    assert complete("bedcheck ") == [*COMMANDS, "--help", "--version"]
    assert complete("bedcheck c") == ["claims", "check", "calibrate", "clean", "compare"]
    assert complete("bedsim ") == [*BEDSIM, "--help", "--version"]


@pytest.mark.parametrize("program, command", [("bedcheck", c) for c in COMMANDS] + [("bedsim", "run")])
def test_bash_offers_the_options(program, command):
    want = {n + ("=" if argument else "") for n, argument in options(program, command).items()}
    assert set(complete(f"{program} {command} --")) == want | {"--help", "--usage"}


def test_bash_offers_values(tmp_path):
    assert complete("bedcheck run --tier=") == ["smoke", "paper", "large"]
    assert complete("bedcheck run --tier l") == ["large"]
    assert complete("bedcheck run --jobs ") == []
    assert complete("bedsim params ") == ["graingas", "suspension"]
    (tmp_path / "results").mkdir()
    assert complete(f"bedcheck check {tmp_path}/r") == [f"{tmp_path}/results"]


def test_zsh_reads_the_same_lists(tmp_path):
    if shutil.which("zsh") is None:
        pytest.skip("zsh is not installed: ci/setup")
    script = (f'source "{COMPLETION}/_bedcheck"\n_bedcheck_commands bedcheck\nprint -- --\n'
              '_bedcheck_options bedcheck run\nprint -- --\n'
              'compadd() { [[ $1 == -S ]] && shift 2; shift; print -l -- "$@" }\n'
              'words=(bedcheck run --tier "") CURRENT=4; _bedcheck\nprint -- --\n'
              'words=(bedsim params "") CURRENT=3; _bedcheck')
    done = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, check=True,
                          cwd=tmp_path, env={**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"})
    assert done.stderr == ""
    commands, flags, tiers, models = (part.split() for part in done.stdout.split("--\n"))
    assert commands == [*COMMANDS, "--help", "--version"]
    want = {n + ("=" if argument else "") for n, argument in options("bedcheck", "run").items()}
    assert set(flags) == want | {"--help", "--usage"}
    assert tiers == ["smoke", "paper", "large"] and models == ["graingas", "suspension"]


# -- installed ---------------------------------------------------------------------------


def test_what_is_installed_works_from_where_it_lies(tmp_path):
    """The layout that CMake installs, with the programs of this build."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    for piece in ("docs/man/${program}.1", "install(DIRECTORY validation", "install(DIRECTORY reference",
                  "docs/completion/_bedcheck", "docs/completion/bedcheck.bash", "docs/examples"):
        assert piece in text, piece
    build = BIN.parent
    if not (build / "cmake_install.cmake").exists() or shutil.which("cmake") is None:
        pytest.skip("the programs do not lie in a build folder of CMake")
    done = call("cmake", "--install", build, "--prefix", tmp_path)
    assert done.returncode == 0, done.stderr
    for path in ("share/man/man1/bedsim.1", "share/man/man1/bedcheck.1",
                 "share/bash-completion/completions/bedcheck", "share/zsh/site-functions/_bedcheck",
                 "share/bedcheck/validation/cases/suspension/compaction.yaml"):
        assert (tmp_path / path).exists(), path
    listed = call(tmp_path / "bin" / "bedcheck", "list", cwd=tmp_path)
    assert listed.returncode == 0 and "suspension/compaction " in listed.stdout, listed.stderr
    planned = call(tmp_path / "bin" / "bedcheck", "run", "suspension/verification-haff", "--dry-run",
                   cwd=tmp_path)
    assert planned.returncode == 0, planned.stderr
    assert not any((tmp_path / "share" / "bedcheck").rglob("*.[ch]"))
