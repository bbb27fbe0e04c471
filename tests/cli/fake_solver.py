"""A third party's solver: it keeps docs/contract.md and solves nothing.

    fake_solver.py run RUN.yaml --seed N --out FILE.h5 [--set name=value]...

Parameters: value (of largest_overlap), noise (its scatter over seeds), slope and
width_l (value + slope width_l^2), from_start (adds the value of the start file),
and mode: good, crash, hang, numerical, refuse, nan, shape, missing, short (a frame too
few), text, empty, nothing, or odd (exit code 9).
"""

import os
import pathlib
import random
import re
import signal
import sys
import time

import h5py
import numpy


def read_run(path):
    """Keys of a run file, parameters included; comments dropped."""
    keys = {}
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        found = re.match(r"\s*([a-z_]+): (.+?)(?:\s+#.*)?$", line)
        if found:
            keys[found.group(1)] = found.group(2)
    return keys


def times(text):
    return [float(word) for word in text.strip("[]").split(",")]


def misbehave(mode):
    """What a solver should not do, as far as it needs no result file."""
    print(f"fake solver: mode {mode}", file=sys.stderr, flush=True)
    if mode == "crash":
        os.kill(os.getpid(), signal.SIGSEGV)
    elif mode == "hang":
        time.sleep(600)
    elif mode == "numerical":
        print("fake solver: step 17: not converged", file=sys.stderr)
        sys.exit(1)
    elif mode == "refuse":
        print("fake solver: RUN.yaml:9: mode: refused", file=sys.stderr)
        sys.exit(2)
    elif mode == "odd":
        sys.exit(9)
    elif mode == "nothing":
        sys.exit(0)


def write_series(file, name, when, values, unit):
    group = file.create_group(f"observables/{name}")
    group["step"] = numpy.arange(len(when), dtype="i8")
    group["time"] = numpy.array(when)
    group["time"].attrs["unit"] = "tau"
    group["value"] = numpy.array(values)
    group["value"].attrs["unit"] = unit


def write_result(out, keys, seed, value):
    when = times(keys["samples"])
    mode = keys.get("mode", "good")
    if mode == "short":
        when = when[:-1]
    values = numpy.full(len(when), value)
    if mode == "nan":
        values[-1] = numpy.nan
    if mode == "shape":
        values = numpy.zeros((len(when), 3))
    with h5py.File(out, "w") as file:
        file.create_group("parameters").attrs["seed"] = float(seed)
        file["parameters"].attrs["recorded"] = 2.5
        write_series(file, "largest_overlap", when, values, "l")
        write_series(file, "solid_fraction_max", when, [0.37 + 1e-3 * value] * len(when), "1")
        if mode != "missing":
            write_series(file, "sweeps_max", when, [float(seed)] * len(when), "1")


def main(words):
    assert words[0] == "run", words
    keys, settings = read_run(words[1]), dict(zip(words[2::2], words[3::2]))
    for flag, text in zip(words[2::2], words[3::2]):
        if flag == "--set":
            keys.update([text.split("=", 1)])
    seed, out = int(settings["--seed"]), settings["--out"]
    mode = keys.get("mode", "good")
    if os.environ.get("FAKE_LOG"):
        with open(os.environ["FAKE_LOG"], "a", encoding="utf-8") as log:
            log.write(f"{pathlib.Path(out).name}\n")
    time.sleep(float(keys.get("sleep", 0)))
    misbehave(mode)
    value = float(keys.get("value", 0.02)) + float(keys.get("noise", 0)) * random.Random(seed).gauss(0, 1)
    value += float(keys.get("slope", 0)) * float(keys.get("width_l", 0)) ** 2
    if "from_start" in keys:
        start = pathlib.Path(words[1]).parent / keys["start_file"]
        with h5py.File(start) as file:
            value += float(file["observables/largest_overlap/value"][-1])
    if mode == "text":
        pathlib.Path(out).write_text("this is no HDF5\n", encoding="utf-8")
    elif mode == "empty":
        pathlib.Path(out).write_bytes(b"")
    else:
        write_result(out, keys, seed, value)
    if os.environ.get("FAKE_BUILD"):
        record = f'{{"format": "fake-record 1", "build": {os.environ["FAKE_BUILD"]}}}\n'
        pathlib.Path(out).with_suffix(".run.json").write_text(record, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
