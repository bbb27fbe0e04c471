"""The suspension model as a user meets it: a small run, its result, and bad input refused."""

import json

import h5py
import numpy as np
import pytest

R, M, T = 6e-4, 2.262e-6, 2e-9
RUN = """\
format: bedcheck-run 1
case: test/spheres
point: only
model: suspension
samples: [0, 0.0213, 0.05]
particle_samples: [0, 0.05]
parameters:
  particles: 300
  width_x_R: 12
  width_y_R: 12
  packing_fraction: 0.35
  boundary_x: periodic
  boundary_y: periodic
  drive: linear
  phibar: 0.4
  phibar_times_s: [0.03]
  phibar_values: [0.45]
"""


def datasets(bedsim):
    """Every dataset that the model says it can write."""
    return [line.split()[0] for line in bedsim("datasets", "suspension").stdout.splitlines()]


@pytest.fixture
def run(bedsim, tmp_path):
    """run(text, *arguments): write the run file, run it; the result's path is run.out."""
    (tmp_path / "runs").mkdir()
    (tmp_path / "h5").mkdir()
    every = "datasets: [" + ", ".join(datasets(bedsim)) + "]\n"

    def go(text=RUN, *arguments, seed=1101):
        (tmp_path / "runs" / "x.yaml").write_text(text.replace("parameters:", every + "parameters:"),
                                                  encoding="utf-8")
        go.out = tmp_path / "h5" / "x.h5"
        return bedsim("run", tmp_path / "runs" / "x.yaml", "--seed", seed, "--out", go.out,
                      *arguments)

    go.folder = tmp_path
    return go


def refused(run, done, *says):
    assert done.returncode == 2, done.stderr
    for text in says:
        assert text in done.stderr
    assert not run.out.exists()


def from_file(text=RUN):
    return (text.replace("model:", "start_file: ../h5/first.h5\nmodel:") +
            "  start: from-file\n")


# -- results -----------------------------------------------------------------------


def test_every_dataset_is_there_with_its_shape_unit_and_exact_times(run, bedsim):
    done = run(RUN, "--quiet")
    assert done.returncode == 0 and done.stdout == "" and done.stderr == ""
    with h5py.File(run.out) as f:
        for name in datasets(bedsim):
            data = f[name] if isinstance(f[name], h5py.Dataset) else f[name]["value"]
            assert data.attrs["unit"], name
            assert np.all(np.isfinite(data)), name
            if not isinstance(f[name], h5py.Dataset):
                times = [0, 0.05] if name.startswith("particles/") else [0, 0.0213, 0.05]
                assert list(f[name]["time"]) == times, name
        spheres = f["particles/spheres"]
        assert spheres["position/value"].shape == (2, 300, 3)
        assert list(spheres["id"]) == list(range(300))
        assert spheres["box"].attrs["dimension"] == 3
        assert [b.decode() for b in spheres["box"].attrs["boundary"]] == [
            "periodic", "periodic", "none"]
        edges = spheres["box/edges/value"][0]
        assert np.allclose(edges, np.diag([12 * R, 12 * R, 300 * 4 / 3 * np.pi / .35 / 144 * R]))
        assert spheres["box/edges/time"] == spheres["position/time"]  # the same object
        assert f["profiles/packing_fraction/value"].shape == (3, 25)
        assert f["parameters"].attrs["model"] == b"suspension"


def test_the_numbers_agree_with_the_spheres(run):
    run(RUN, "--quiet")
    with h5py.File(run.out) as f:
        v = f["particles/spheres/velocity/value"][-1]
        x = f["particles/spheres/position/value"][-1]
        o = {name: f["observables"][name]["value"][:] for name in f["observables"]}
        height = f["particles/spheres/box/edges/value"][0][2, 2]
        profile = f["profiles/packing_fraction/value"][-1]
        z = f["derived"].attrs["Z"]
    assert np.isclose(o["kinetic_energy"][-1], M * np.sum(v * v) / 2, rtol=1e-12)
    assert np.allclose(o["momentum"][-1], M * v.sum(axis=0), rtol=0, atol=1e-12 * M)
    assert np.allclose(o["centre_of_mass"][-1], x.mean(axis=0), rtol=1e-12)
    count, _ = np.histogram(x[:, 2], bins=25, range=(0, height))
    volume = 4 / 3 * np.pi * R**3
    assert np.allclose(profile, count * volume / ((12 * R)**2 * height / 25))
    assert np.isclose(o["temperature"][0], T, rtol=1e-12)
    # What was given is what was taken and what is left (see tests/unit/test_suspension.c).
    left = (o["kinetic_energy"][0] + o["noise_energy"] + o["drive_energy"] - o["drag_energy"] -
            o["dissipated_energy"])
    assert np.allclose(left, o["kinetic_energy"], rtol=1e-4)
    assert o["collisions"][0] == o["kicks"][0] == 0 and o["collisions"][-1] > 300
    assert abs(o["kicks"][-1] - 300 * 250 * 0.05) < 5 * np.sqrt(300 * 250 * 0.05)
    assert list(o["phibar"]) == [0.4, 0.4, 0.45]
    assert o["noise_variance"][2] > o["noise_variance"][1]
    assert np.all(o["largest_overlap"] < 1e-9)
    assert 0 < o["layer_fraction_error"][-1][0] <= o["layer_fraction_error"][-1][1] < 0.1
    assert np.isclose(z, 15.977, rtol=1e-4)


def test_images_unfold_what_crossed_a_periodic_side(run):
    text = RUN.replace("0.0213, 0.05]", "0.0213, 0.05, 0.6]").replace("[0, 0.05]", "[0, 0.05, 0.6]")
    run(text, "--quiet")
    with h5py.File(run.out) as f:
        image = f["particles/spheres/image/value"][-1]
        x = f["particles/spheres/position/value"][:]
    assert np.any(image[:, 0] > 0) and np.any(image[:, 1] < 0) and not np.any(image[:, 2])
    assert np.all(x >= 0) and np.all(x[:, :, :2] < 12 * R)


def test_the_same_seed_gives_the_same_bytes(run):
    run(RUN, "--quiet")
    first = run.out.read_bytes()
    run(RUN, "--quiet")
    assert run.out.read_bytes() == first
    run(RUN, "--quiet", seed=1102)
    assert run.out.read_bytes() != first


def test_a_run_goes_on_from_an_earlier_one_in_a_higher_box(run):
    run(RUN, "--quiet")
    (run.folder / "h5" / "first.h5").write_bytes(run.out.read_bytes())
    higher = from_file().replace("packing_fraction: 0.35", "height_R: 60")
    assert run(higher, "--quiet").returncode == 0
    with h5py.File(run.out) as new, h5py.File(run.folder / "h5" / "first.h5") as old:
        for name in ("position", "velocity"):
            path = f"particles/spheres/{name}/value"
            assert np.allclose(new[path][0], old[path][-1], rtol=1e-14, atol=0)


def test_cost_is_told_by_part_and_kind(run):
    run(RUN, "--quiet")
    cost = json.loads((run.folder / "h5" / "x.run.json").read_text(encoding="utf-8"))["cost"]
    for name in ("start_s", "events_and_kicks_s", "looks_s", "collisions", "kicks", "stale_events",
                 "cell_crossings", "engine_bytes_per_sphere"):
        assert cost[name] > 0, name


def test_an_unstable_bed_is_said_to_be_one(run):
    assert "linearly unstable" in run().stderr
    assert run(RUN, "--set", "drive=none").stderr == ""


def test_the_model_says_what_it_takes_and_gives(bedsim):
    assert "suspension" in bedsim("models").stdout
    parameters = bedsim("params", "suspension").stdout
    assert "restitution = 0.7" in parameters and "source: FZ" in parameters
    assert "observables/q6" in bedsim("datasets", "suspension").stdout


# -- bad input -----------------------------------------------------------------------


@pytest.mark.parametrize("setting, says", [
    ("particles=0", "particles"),
    ("particles=1", "a single sphere has no temperature"),
    ("particles=nan", "particles"),
    ("radius_m=-6e-4", "radius_m"),
    ("thermal_energy_J=nan", "thermal_energy_J"),
    ("packing_fraction=0.59", "the start reaches 0.58 between hard walls"),
    ("kick_rate_per_s=0", "0 with a drive"),
    ("layer_R=40", "a layer of 40 R in a box"),
    ("phibar_values=[]", "0 values for 1 phibar_times_s"),
    ("height_R=40", "leave one of them out"),
    ("start=from-file", "start_file"),
    ("start=list", "sphere_x: 0 values"),
    ("drive=linaer", "linear"),
    ("kick_rate_per=3", "did you mean 'kick_rate_per_s'"),
])
def test_bad_settings(run, setting, says):
    refused(run, run(RUN, "--set", setting), says)


def test_a_schedule_out_of_order_is_named_with_its_place(run):
    text = RUN.replace("[0.03]", "[0.03, 0.02]").replace("[0.45]", "[0.45, 0.4]")
    refused(run, run(text), "phibar_times_s: out of order: 0.02 s comes after 0.03 s", "x.yaml:")


def test_start_files_of_other_models_and_sizes_are_refused(run, bedsim, tmp_path):
    run(RUN, "--quiet")
    (run.folder / "h5" / "first.h5").write_bytes(run.out.read_bytes())
    run.out.unlink()
    refused(run, run(from_file(), "--set", "particles=299"), "particles is 300 there and 299")
    refused(run, run(from_file(), "--set", "radius_m=5e-4"), "radius_m is 0.0006 there and 0.0005")
    flat = from_file().replace("packing_fraction: 0.35", "height_R: 20")
    refused(run, run(flat), "start")
    gas = RUN.split("parameters:")[0].replace("suspension", "graingas") + \
        "datasets: [particles/grains/position]\nparameters:\n  grains: 3\n"
    (tmp_path / "runs" / "g.yaml").write_text(gas, encoding="utf-8")
    (run.folder / "h5" / "first.h5").unlink()
    done = bedsim("run", tmp_path / "runs" / "g.yaml", "--seed", 1, "--out",
                  run.folder / "h5" / "first.h5")
    assert done.returncode == 0, done.stderr
    refused(run, run(from_file()), "is a result of the model graingas; suspension is needed")
    refused(run, run(from_file().replace("from-file", "random")), "start is not from-file")
