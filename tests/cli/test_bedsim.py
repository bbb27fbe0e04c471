"""bedsim as a user meets it: one run file, one seed, one result file; bad input refused."""

import json
import os
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest

from conftest import BIN, ROOT

RUN = """\
format: bedcheck-run 1
case: test/small
point: only
model: graingas
samples: [0, 0.25, 0.5]
particle_samples: [0, 0.5]
datasets: [particles/grains/position, particles/grains/velocity, particles/grains/id,
           particles/grains/radius, particles/grains/species, particles/grains/force,
           fields/solid_fraction, fields/pressure, observables/collisions, observables/wall_impulse]
parameters:
  grains: 400
  width_l: 11
  height_l: 13
"""


@pytest.fixture
def run(bedsim, tmp_path):
    """run(text, *arguments): write the run file, run it; the result's path is run.out."""
    (tmp_path / "runs").mkdir()
    (tmp_path / "h5").mkdir()

    def go(text=RUN, *arguments, seed=1101, out=None):
        (tmp_path / "runs" / "x.yaml").write_text(text, encoding="utf-8")
        go.out = tmp_path / "h5" / "x.h5" if out is None else out
        return bedsim("run", tmp_path / "runs" / "x.yaml", "--seed", seed, "--out", go.out,
                      *arguments)

    go.folder = tmp_path
    return go


def refused(done, *says):
    assert done.returncode == 2, done.stderr
    for text in says:
        assert text in done.stderr


def nothing_written(run):
    return not any(path.is_file() for path in (run.folder / "h5").rglob("*"))


# -- results ---------------------------------------------------------------------


def test_the_result_is_what_was_asked_for_in_h5md(run):
    done = run()
    assert done.returncode == 0 and done.stdout == "" and done.stderr == ""
    with h5py.File(run.out) as f:
        assert list(f["h5md"].attrs["version"]) == [1, 1]
        assert f["h5md/creator"].attrs["name"] == b"bedsim"
        assert "name" in f["h5md/author"].attrs and "version" in f["h5md/creator"].attrs
        grains = f["particles/grains"]
        assert grains["position/value"].shape == (2, 400, 2)
        assert list(grains["position/time"]) == [0, 0.5]
        assert list(grains["position/step"]) == [0, 40]
        assert grains["box"].attrs["dimension"] == 2
        assert [b.decode() for b in grains["box"].attrs["boundary"]] == ["none", "none"]
        assert grains["box/edges/step"] == grains["position/step"]  # the same object
        assert np.array_equal(grains["box/edges/value"][0], [[11, 0], [0, 13]])
        assert sorted(grains["id"]) == list(range(400))
        assert f["fields/pressure/value"].shape == (3, 14, 12)
        assert f["observables/wall_impulse/value"].shape == (3, 4)
        assert f["parameters"].attrs["grains"] == 400 and f["parameters"].attrs["seed"] == 1101
        assert f["parameters"].attrs["darcy"] == b"published"
        f.visititems(lambda name, item: check_unit(name, item))
        units = {name: f[name].attrs["unit"] for name in
                 ("particles/grains/position/value", "fields/pressure/value")}
    assert set(map(bytes, units.values())) == {b"l", b"P0"}


def check_unit(name, item):
    if isinstance(item, h5py.Dataset):
        assert "unit" in item.attrs, name


def test_the_same_seed_gives_the_same_bytes(run):
    run()
    first = run.out.read_bytes()
    time.sleep(1.1)  # nothing volatile, such as a time of day, may be inside
    run()
    assert run.out.read_bytes() == first
    run(seed=1102)
    assert run.out.read_bytes() != first


def test_provenance_stands_beside_the_result(run):
    run()
    record = json.loads((run.folder / "h5" / "x.run.json").read_text(encoding="utf-8"))
    assert record["build"]["compiler"] and record["build"]["commit"] and record["build"]["dirty"]
    assert record["cost"]["steps"] == 40 and record["wall_s"] > 0


def test_a_case_is_accepted_and_says_what_it_took(bedsim, tmp_path):
    case = ROOT / "validation" / "cases" / "graingas" / "sedimentation.yaml"
    done = bedsim("run", case, "--seed", 1, "--out", tmp_path / "x.h5",
                  "--set", "grains=0", "--set", "width_l=5")
    assert done.returncode == 0
    assert "height_l = 58 (first of 7)" in done.stderr
    with h5py.File(tmp_path / "x.h5") as f:
        assert f["parameters"].attrs["height_l"] == 58 and f["parameters"].attrs["width_l"] == 5


def test_a_run_goes_on_from_an_earlier_result(run, bedsim):
    run()
    (run.folder / "h5" / "first.h5").write_bytes(run.out.read_bytes())
    text = RUN.replace("model:", "start_file: ../h5/first.h5\nmodel:") + "  start: from-file\n"
    assert run(text).returncode == 0
    with h5py.File(run.out) as new, h5py.File(run.folder / "h5" / "first.h5") as old:
        assert np.array_equal(new["particles/grains/position/value"][0],
                              old["particles/grains/position/value"][-1])
        assert np.array_equal(new["particles/grains/radius"], old["particles/grains/radius"])
    refused(run(text.replace("grains: 400", "grains: 399")), "399 grains")


def test_lists_name_units_ranges_and_sources(bedsim):
    assert bedsim("models").stdout.startswith("graingas")
    parameters = bedsim("params", "graingas").stdout
    assert "restitution = 0.8  (1; 0 .. 1)" in parameters and "source: MFM" in parameters
    assert "fields/pressure" in bedsim("datasets", "graingas").stdout
    assert bedsim("params", "grangas").returncode == 2
    assert bedsim("--version").stdout.startswith("bedsim ")


# -- bad input ---------------------------------------------------------------------


@pytest.mark.parametrize(
    "change, says",
    [
        (("grains: 400", "grain: 400"), ["x.yaml:11:3", "did you mean 'grains'"]),
        (("grains: 400", "grains: many"), ["x.yaml:11:11", "many"]),
        (("grains: 400", "grains: 4e2"), ["x.yaml:11:11"]),
        (("grains: 400", "grains: -1"), ["x.yaml:11:11", "-1"]),
        (("grains: 400", "grains: 4000"), ["x.yaml:11:11", "can be placed"]),
        (("grains: 400", "grains: 400\n  dt_tau: 0.08"), ["x.yaml:12:11", "stability bound"]),
        (("grains: 400", "grains: 400\n  dt_tau: nan"), ["x.yaml:12:11"]),
        (("grains: 400", "grains: 400\n  darcy: wrong"), ["x.yaml:12:10", "published"]),
        (("model: graingas", "model: grangas"), ["did you mean 'graingas'"]),
        (("fields/pressure", "fields/presure"), ["fields/presure"]),
        (("samples: [0, 0.25, 0.5]\nparticle", "samples: [0, 0.5, 0.25]\nparticle"), ["x.yaml:5"]),
        (("grains: 400", "grains: &a 400"), ["anchor"]),
        (("grains: 400", "grains: !!int 400"), ["tag"]),
        (("grains: 400\n", "grains: 400\n---\nb: 1\n"), ["document"]),
        (("grains: 400", "grains: [400"), ["x.yaml:"]),
    ],
)
def test_what_is_wrong_is_named_with_its_place(run, change, says):
    refused(run(RUN.replace(*change)), *says)
    assert nothing_written(run)


def test_several_faults_are_told_at_once(run):
    done = run(RUN.replace("grains: 400", "grains: -1\n  restitution: 1.5\n  frude: 1"))
    refused(done, "x.yaml:11:11", "x.yaml:12:16", "x.yaml:13:3")


@pytest.mark.parametrize("setting, says", [
    ("restitution=2", "restitution"), ("restitution", "restitution"), ("nobody=1", "nobody"),
    ("dt_tau=0.07", "stability bound"), ("grains=", "grains")])
def test_bad_settings(run, setting, says):
    refused(run(RUN, "--set", setting), says)
    assert nothing_written(run)


def test_bad_command_lines(bedsim, tmp_path):
    (tmp_path / "x.yaml").write_text(RUN, encoding="utf-8")
    out = tmp_path / "x.h5"
    for arguments in ([], ["run"], ["run", tmp_path / "x.yaml", "--out", out],
                      ["run", tmp_path / "x.yaml", "--seed", "1"],
                      ["run", tmp_path / "x.yaml", "--seed", "-1", "--out", out],
                      ["run", tmp_path / "x.yaml", "--seed", "1.5", "--out", out],
                      ["run", tmp_path / "none.yaml", "--seed", "1", "--out", out],
                      ["run", tmp_path / "x.yaml", "--seed", "1", "--out", tmp_path / "no" / "x.h5"],
                      ["run", tmp_path / "x.yaml", "--seed", "1", "--out", "/proc/x.h5"],
                      ["dance"]):
        assert bedsim(*arguments).returncode == 2, arguments
    assert not out.exists()


@pytest.mark.parametrize("name", ["/etc/passwd", "../../h5/x.h5", "../h5/../../x.h5"])
def test_a_start_file_stays_within_the_output_folder(run, name):
    refused(run(RUN.replace("model:", f"start_file: {name}\nmodel:") + "  start: from-file\n"),
            "start_file")


def plant(path, kind):
    """A result file that must not be trusted."""
    with h5py.File(path, "w") as f:
        g = f.create_group("particles/grains")
        if kind == "external link":
            g["position"] = h5py.ExternalLink("other.h5", "/x")
        elif kind == "soft link":
            g["position"] = h5py.SoftLink("/x")
        elif kind == "external storage":
            g.create_dataset("radius", (400,), "f8", external=[("/etc/hostname", 0, 3200)])
        elif kind == "virtual":
            layout = h5py.VirtualLayout((400,), "f8")
            layout[:] = h5py.VirtualSource("other.h5", "x", (400,))
            g.create_virtual_dataset("radius", layout)
        elif kind == "filter":
            g.create_dataset("radius", (400,), "f8", compression="lzf")
        elif kind == "huge":
            g.create_dataset("position/value", (1, 1 << 40, 2), "f8", chunks=(1, 1024, 2))


@pytest.mark.parametrize("kind", ["external link", "soft link", "external storage", "virtual",
                                  "filter", "huge", "empty"])
def test_foreign_files_are_refused(run, kind):
    plant(run.folder / "h5" / "first.h5", kind)
    done = run(RUN.replace("model:", "start_file: ../h5/first.h5\nmodel:") +
               "  start: from-file\n")
    refused(done, "first.h5")
    assert not run.out.exists()


def test_a_damaged_file_is_refused(run):
    run()
    whole = bytearray(run.out.read_bytes())
    with h5py.File(run.out) as f:
        at = f["particles/grains/position/value"].id.get_chunk_info(1).byte_offset  # the last
    whole[at + 12345 % 3000] ^= 4
    (run.folder / "h5" / "first.h5").write_bytes(bytes(whole))
    refused(run(RUN.replace("model:", "start_file: ../h5/first.h5\nmodel:") +
                "  start: from-file\n"), "first.h5")


# -- interruption --------------------------------------------------------------------


def test_an_interrupted_run_leaves_nothing(tmp_path):
    (tmp_path / "x.yaml").write_text(RUN.replace("0.5]", "500000]"), encoding="utf-8")
    process = subprocess.Popen(
        [str(BIN / "bedsim"), "run", str(tmp_path / "x.yaml"), "--seed", "1", "--out",
         str(tmp_path / "x.h5")], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    time.sleep(1)
    assert process.poll() is None
    os.kill(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=20)
    assert process.returncode == 130 and "interrupted at t =" in said
    assert sorted(path.name for path in tmp_path.iterdir()) == ["x.yaml"]
