"""Results open elsewhere: H5MD by its specification, XDMF sidecars read back by its rules."""

import xml.etree.ElementTree as xml

import h5py
import numpy as np
import pytest

GRAINS = """\
format: bedcheck-run 1
case: test/grains
point: only
model: graingas
samples: [0, 0.05, 0.2]
particle_samples: [0, 0.2]
parameters:
  grains: 60
  width_l: 7
  height_l: 9
"""
SPHERES = """\
format: bedcheck-run 1
case: test/spheres
point: only
model: suspension
samples: [0, 0.01]
particle_samples: [0, 0.005, 0.01]
parameters:
  particles: 120
  width_x_R: 12
  width_y_R: 11
  packing_fraction: 0.3
  boundary_x: periodic
"""


@pytest.fixture
def result(bedsim, tmp_path):
    """result(text, name="x.h5", only=...): a run with every dataset, or those with `only`."""

    def go(text, name="x.h5", only=""):
        model = "graingas" if "graingas" in text else "suspension"
        names = [line.split()[0] for line in bedsim("datasets", model).stdout.splitlines()]
        names = [n for n in names if only in n]
        asked = f"datasets: [{', '.join(names)}]\nparameters:"
        (tmp_path / "x.yaml").write_text(text.replace("parameters:", asked), encoding="utf-8")
        done = bedsim("run", tmp_path / "x.yaml", "--seed", 5, "--out", tmp_path / name, "--quiet")
        assert done.returncode == 0, done.stderr
        return tmp_path / name

    return go


# -- H5MD 1.1 ----------------------------------------------------------------------------


def text(value):
    return isinstance(value, (str, bytes, np.bytes_))


def check_element(node, where):
    """A time-dependent element: step, time, value of one length; or a fixed dataset."""
    if isinstance(node, h5py.Dataset):
        return node.shape
    assert set(node) == {"step", "time", "value"}, where
    step, time, value = node["step"], node["time"], node["value"]
    assert np.issubdtype(step.dtype, np.integer) and step.ndim == time.ndim == 1, where
    assert len(step) == len(time) == len(value) > 0, where
    assert np.all(np.diff(step) >= 0) and np.all(np.diff(time) > 0), where
    return value.shape[1:]


def check_particles(group, where):
    box = group["box"]
    d = int(box.attrs["dimension"])
    boundary = [b.decode() for b in np.atleast_1d(box.attrs["boundary"])]
    assert len(boundary) == d and set(boundary) <= {"none", "periodic"}, where
    assert check_element(box["edges"], where) in ((d,), (d, d)), where
    # "edges" of a moving box has the very times of the positions
    assert box["edges/step"] == group["position/step"], where
    assert box["edges/time"] == group["position/time"], where
    count, dimension = check_element(group["position"], where)
    assert dimension == d, where
    for name in set(group) - {"box", "position"}:
        shape = check_element(group[name], f"{where}/{name}")
        want = (count, d) if name in ("velocity", "force", "image") else (count,)
        assert shape == want, f"{where}/{name}"
    for name in {"id", "species", "image"} & set(group):
        data = group[name] if isinstance(group[name], h5py.Dataset) else group[name]["value"]
        assert np.issubdtype(data.dtype, np.integer), f"{where}/{name}"
    assert len(set(group["id"])) == count, where


@pytest.mark.parametrize("run, name", [(GRAINS, "grains"), (SPHERES, "spheres")])
def test_both_models_keep_h5md(result, run, name):
    with h5py.File(result(run)) as f:
        version = f["h5md"].attrs["version"]
        assert list(version) == [1, 1] and np.issubdtype(version.dtype, np.integer)
        assert text(f["h5md/author"].attrs["name"])
        assert text(f["h5md/creator"].attrs["name"]) and text(f["h5md/creator"].attrs["version"])
        assert list(f["particles"]) == [name]
        check_particles(f["particles"][name], name)
        for observable in f["observables"].values():
            check_element(observable, observable.name)
        missing = []
        f.visititems(lambda path, node: missing.append(path) if isinstance(node, h5py.Dataset)
                     and not text(node.attrs.get("unit")) else None)
        assert missing == []


# -- XDMF 3 ------------------------------------------------------------------------------


def numbers(item):
    return np.array(item.text.split(), dtype=float)


def array(item, folder):
    """The values of a DataItem, by the rules of the format."""
    dims = tuple(int(n) for n in item.get("Dimensions").split())
    if item.get("ItemType") == "HyperSlab":
        choice, source = item
        assert choice.get("Dimensions") == f"3 {len(source.get('Dimensions').split())}"
        start, stride, count = numbers(choice).astype(int).reshape(3, -1)
        assert np.prod(count) == np.prod(dims)
        pick = tuple(slice(a, a + s * n, s) for a, s, n in zip(start, stride, count))
        return array(source, folder)[pick].reshape(dims)
    if item.get("Format") == "XML":
        return numbers(item).reshape(dims)
    assert item.get("Format") == "HDF" and item.get("Precision") == "8"
    name, _, path = item.text.strip().rpartition(":")
    with h5py.File(folder / name) as f:
        assert f[path].shape == dims and f[path].dtype.itemsize == 8
        assert {"Float": "f", "Int": "i"}[item.get("NumberType")] == f[path].dtype.kind
        return f[path][()]


def grids(path, name):
    """The frames of a temporal collection."""
    root = xml.parse(path).getroot()
    assert root.tag == "Xdmf" and root.get("Version") == "3.0"
    domain, = root
    assert domain.tag == "Domain"
    collection = next(g for g in domain if g.get("Name") == name)
    assert collection.get("GridType") == "Collection"
    assert collection.get("CollectionType") == "Temporal"
    return list(collection)


def attributes(grid, folder):
    found = {}
    for a in grid.findall("Attribute"):
        assert a.get("AttributeType") == "Scalar" and a.get("Center") == "Node"
        found[a.get("Name")] = array(a[0], folder)
    return found


def test_fields_are_read_back_site_by_site(result, bedsim, tmp_path):
    path = result(GRAINS)
    before = path.read_bytes()
    done = bedsim("xdmf", path)
    assert done.returncode == 0 and done.stdout == f"{tmp_path}/x.xdmf\n"
    frames = grids(tmp_path / "x.xdmf", "fields")
    with h5py.File(path) as f:
        assert [float(g.find("Time").get("Value")) for g in frames] == list(f["fields/pressure/time"])
        for k, grid in enumerate(frames):
            topology, geometry = grid.find("Topology"), grid.find("Geometry")
            # one site thick: readers put a mesh of two dimensions into the plane of y and z
            assert topology.get("TopologyType") == "3DCoRectMesh"
            assert topology.get("Dimensions") == "1 10 8"
            assert geometry.get("GeometryType") == "ORIGIN_DXDYDZ"
            assert [list(array(i, tmp_path)) for i in geometry] == [[0, 0, 0], [1, 1, 1]]
            found = attributes(grid, tmp_path)
            for name in ("pressure", "solid_fraction", "collision_virial"):
                assert np.array_equal(found[name], f[f"fields/{name}/value"][k:k + 1]), name
            for c, name in enumerate(("grain_velocity_x", "grain_velocity_y")):
                assert np.array_equal(found[name], f["fields/grain_velocity/value"][k:k + 1, :, :, c])
            assert len(found) == 5
    assert path.read_bytes() == before


@pytest.mark.parametrize("run, name, kind", [(GRAINS, "grains", "XY"), (SPHERES, "spheres", "XYZ")])
def test_particles_are_read_back(result, bedsim, tmp_path, run, name, kind):
    path = result(run)
    assert bedsim("xdmf", path).returncode == 0
    frames = grids(tmp_path / "x.xdmf", name)
    with h5py.File(path) as f:
        group = f[f"particles/{name}"]
        assert len(frames) == len(group["position/time"])
        for k, grid in enumerate(frames):
            assert float(grid.find("Time").get("Value")) == group["position/time"][k]
            assert grid.find("Topology").get("TopologyType") == "Polyvertex"
            assert int(grid.find("Topology").get("NumberOfElements")) == len(group["id"])
            assert grid.find("Geometry").get("GeometryType") == kind
            place = array(grid.find("Geometry")[0], tmp_path)
            assert np.array_equal(place, group["position/value"][k])
            found = attributes(grid, tmp_path)
            assert np.array_equal(found["radius"], group["radius"])
            assert kind == "XYZ" or np.array_equal(found["species"], group["species"])
            assert np.array_equal(found["velocity_y"], group["velocity/value"][k, :, 1])


def test_a_name_with_marks_of_xml_and_a_result_without_arrays(result, bedsim, tmp_path):
    path = result(GRAINS, 'a<b>&"c.h5', only="fields/")
    assert bedsim("xdmf", path).returncode == 0
    frames = grids(tmp_path / 'a<b>&"c.xdmf', "fields")
    assert attributes(frames[2], tmp_path)["pressure"].shape == (1, 10, 8)
    path = result(SPHERES, "profiles.h5", only="profiles/")
    done = bedsim("xdmf", path)
    assert done.returncode == 2 and "neither fields nor particles" in done.stderr
    assert not (tmp_path / "profiles.xdmf").exists()
    assert bedsim("xdmf", tmp_path / "none.h5").returncode == 2
