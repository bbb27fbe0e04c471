#!/usr/bin/env python3
"""A solver that is not ours: the kinematic wave of a bed, by finite volumes.

    kinematic_solver.py run RUN.yaml --seed N --out FILE.h5 [--set NAME=VALUE]... [--quiet]

It keeps docs/contract.md and nothing more, so bedcheck can judge it:

    bedcheck run suspension/compaction-kinematic --solver docs/examples/kinematic_solver.py

What it solves.  The flow is switched at one time to what supports the packing fraction b.  Where
friction is strong, spheres at packing fraction phi then rise at c (phi - b), and continuity is

    d phi/dt + d f/dz = 0,    f = c phi (phi - b),    no flux through the floor,
    c = n g' / ((1 - b) gamma(b)),    gamma(b) = gamma0 (1 - b)^-n,

(Fiege & Zippelius, Eq. 9; docs/theory.md, S7).  f is convex, so Godunov's flux is one line.  Left
out: pressure, inertia, spheres, chance.  Needs h5py, numpy and PyYAML.
"""

import argparse
import os
import sys

import h5py
import numpy as np
import yaml

CELLS_A_BIN = 8  # finer than the profile that is asked for: fronts are smeared over cells
COURANT = 0.8

# Every name that this solver knows, with the value it takes when a run file does not name it.
# None: has to be named.  The second table is known, checked for spelling and without effect here:
# the kinematic wave has neither temperature nor collisions.
USED = {
    "particles": None, "width_x_R": None, "width_y_R": None, "height_R": None,
    "radius_m": 6e-4, "phibar": None, "phibar_times_s": None, "phibar_values": None,
    "drive": "linear", "drive_scale": 1.0, "drag_per_s": 5.0, "exponent": 4.65,
    "gravity_m_per_s2": 9.81, "density_contrast": 0.6, "profile_bin_R": 1.0, "start": None,
}
IDLE = {"restitution", "thermal_energy_J", "temperature_scale", "mass_kg", "layer_R",
        "kick_rate_per_s", "kick_schedule", "noise_rate"}
DATASETS = ["profiles/packing_fraction"]


class Refused(ValueError):
    """The input is not what this solver can take: exit code 2."""


# -- the run file ------------------------------------------------------------------------


def plain(value):
    """What YAML 1.1 takes for a text but is a number: it wants a point and a sign in 2e-9."""
    if isinstance(value, list):
        return [plain(one) for one in value]
    try:
        return float(value)
    except (TypeError, ValueError):
        return value


def positive(name, value):
    if not (isinstance(value, float) and 0 < value < np.inf):
        raise Refused(f"{name}: {value!r}: must be a number above 0")
    return value


def times(name, value):
    """A list, or {from, to, every} with both ends."""
    if isinstance(value, dict):
        first, last, every = (float(value[key]) for key in ("from", "to", "every"))
        if not (every > 0 and last >= first):
            raise Refused(f"{name}: from {first:g} to {last:g} every {every:g}: no times")
        value = first + every * np.arange(round((last - first) / every) + 1)
    value = np.array(value, dtype=float)
    if value.ndim != 1 or len(value) == 0 or value[0] < 0 or np.any(np.diff(value) <= 0):
        raise Refused(f"{name}: not a rising list of times")
    return value


def read_run(path, settings):
    """Run file and --set -> (parameters, times of the samples)."""
    with open(path, encoding="utf-8") as file:
        run = yaml.safe_load(file)
    if run.get("format") != "bedcheck-run 1":
        raise Refused(f"format: {run.get('format')!r}, not 'bedcheck-run 1'")
    if run["model"] != "suspension":
        raise Refused(f"model: {run['model']!r}; this solver knows 'suspension'")
    if "start_file" in run:
        raise Refused("start_file: this solver starts from its parameters")
    for name in run["datasets"]:
        if name not in DATASETS:
            raise Refused(f"datasets: {name}: this solver has none; it writes {', '.join(DATASETS)}")
    given = {name: plain(value) for name, value in run["parameters"].items()}
    for setting in settings:
        name, _, value = setting.partition("=")
        given[name] = plain(yaml.safe_load(value))
    for name in given:
        if name not in USED and name not in IDLE:
            raise Refused(f"parameters: {name}: unknown to this solver")
    for name, standard in USED.items():
        if name not in given and standard is None:
            raise Refused(f"parameters: {name}: missing")
    return {**USED, **given}, times("samples", run["samples"])


# -- the bed -----------------------------------------------------------------------------


class Bed:
    """A slab of packing fraction phibar under its load, in cells; lengths in R, times in s."""

    def __init__(self, p):
        if p["start"] != "sharp" or p["drive"] != "linear":
            raise Refused("only start: sharp and drive: linear")
        change, new = p["phibar_times_s"], p["phibar_values"]
        if len(change) != 1 or len(new) != 1 or change[0] != 0:
            raise Refused("phibar_times_s, phibar_values: one change, at time 0")
        before, self.after = positive("phibar", p["phibar"]), positive("phibar_values", new[0])
        if before >= 0.74 or self.after >= 0.74:
            raise Refused("phibar: spheres do not pack as dense as .74")
        radius = positive("radius_m", p["radius_m"])
        pull = (positive("gravity_m_per_s2", p["gravity_m_per_s2"]) * positive("drive_scale", p["drive_scale"])
                * positive("density_contrast", p["density_contrast"]))
        exponent = positive("exponent", p["exponent"])
        drag = positive("drag_per_s", p["drag_per_s"]) * (1 - self.after) ** -exponent
        self.speed = exponent * pull / (1 - self.after) / drag / radius  # c (R/s)
        load = positive("particles", p["particles"]) * 4 / 3 * np.pi  # height of solid (R)
        load /= positive("width_x_R", p["width_x_R"]) * positive("width_y_R", p["width_y_R"])
        height = positive("height_R", p["height_R"])
        if load / min(before, self.after) > height:
            raise Refused(f"height_R: {height:g}: the bed is {load / min(before, self.after):g} R high")
        self.bins = round(height / positive("profile_bin_R", p["profile_bin_R"]))
        self.bin_m = height * radius / self.bins
        self.cell = height / self.bins / CELLS_A_BIN
        edge = self.cell * np.arange(self.bins * CELLS_A_BIN + 1)
        self.phi = before * np.diff(np.minimum(edge, load / before)) / self.cell
        self.time, self.steps = 0.0, 0

    def flux(self, phi):
        return self.speed * phi * (phi - self.after)

    def step(self, dt):
        """Godunov: at each face the exact flux between the cells below and above it."""
        lowest = self.after / 2  # where f is least
        below, above = self.phi[:-1], self.phi[1:]
        through = np.maximum(self.flux(np.maximum(below, lowest)), self.flux(np.minimum(above, lowest)))
        through = np.concatenate(([0.0], through, [0.0]))  # floor and lid
        self.phi = self.phi - dt / self.cell * np.diff(through)

    def advance(self, time):
        fastest = self.speed * max(self.after, 2 * self.phi.max() - self.after)
        count = int(np.ceil((time - self.time) * fastest / (COURANT * self.cell)))
        for _ in range(count):
            self.step((time - self.time) / count)
        self.time, self.steps = time, self.steps + count
        if not np.all(np.isfinite(self.phi)):
            raise FloatingPointError(f"step {self.steps}: not a number")

    def profile(self):
        return self.phi.reshape(self.bins, CELLS_A_BIN).mean(axis=1)


# -- the result ----------------------------------------------------------------------------


def write(path, parameters, seed, bed, samples):
    """Under another name first: a result appears whole or not at all."""
    unfinished = f"{path}.part"
    steps, values = [], []
    for time in samples:
        bed.advance(time)
        steps.append(bed.steps)
        values.append(bed.profile())
    try:
        with h5py.File(unfinished, "w", track_order=False) as file:
            file.create_group("h5md").attrs["version"] = np.array([1, 1])
            file.create_group("h5md/author").attrs["name"] = "bedcheck's example"
            creator = file.create_group("h5md/creator")
            creator.attrs["name"], creator.attrs["version"] = "kinematic_solver.py", "1"
            used = file.create_group("parameters").attrs
            used["seed"] = float(seed)
            for name, value in parameters.items():
                if name in USED:
                    used[name] = value
            file.create_group("profiles").attrs["spacing"] = bed.bin_m
            series = file.create_group("profiles/packing_fraction")
            for name, data, unit in (("step", np.array(steps), "1"), ("time", samples, "s"),
                                     ("value", np.array(values), "1")):
                series.create_dataset(name, data=data).attrs["unit"] = unit
        os.replace(unfinished, path)
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)


def main(bed_type=Bed):
    parser = argparse.ArgumentParser(description="The kinematic wave of a bed.")
    parser.add_argument("command", choices=["run"])
    parser.add_argument("run_file")
    parser.add_argument("--seed", type=int, required=True, help="has no effect: nothing here is random")
    parser.add_argument("--out", required=True)
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--quiet", action="store_true")
    words = parser.parse_args()
    try:
        parameters, samples = read_run(words.run_file, words.set)
        write(words.out, parameters, words.seed, bed_type(parameters), samples)
    except (ValueError, OSError, yaml.YAMLError, KeyError, TypeError, AttributeError) as why:
        print(f"{words.run_file}: {why}", file=sys.stderr)
        return 2
    except FloatingPointError as why:
        print(f"{words.run_file}: {why}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
