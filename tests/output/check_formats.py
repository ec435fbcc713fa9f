"""Every format but GLB: compares what readers that are not ours find in a file with what went into it.

Oracle: the leaf-frame data beside each sample, brought into the file's coordinates by the formulas of check_glb.py;
grids are read by VTK. Prints a line per format: reader, frames, largest error of a position.
Usage: check_formats.py SAMPLE ... (SAMPLE.json and SAMPLE.obj, SAMPLE.pc2, ... beside it)
"""
import json
import pathlib
import sys

import numpy as np
import readers
from check_glb import EPS, near, normals_of, placed

FRAME_RATE = 24
HOURS_PER_ITERATION = 0.48

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    vtkXMLUnstructuredGridReader = None


def srgb(linear):
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)


class Sample:
    def __init__(self, stem):
        self.stem = stem
        self.dump = json.load(open(stem + ".json"))
        self.frames = self.dump["frames"]
        self.blade = [placed(self.dump, frame["positions"]) for frame in self.frames]
        self.faces = np.array(self.dump["mesh_faces"])
        self.vertex = np.array(self.dump["skin"]["vertex"])
        self.uv = np.array(self.dump["skin"]["uv"])
        iterations = np.array([frame["iteration"] for frame in self.frames], float)
        self.times = self.dump["seconds"] * iterations / max(iterations[-1], 1)
        self.iterations = iterations
        self.has_stalk = len(self.frames[0]["stalk"]) > 0
        self.textured = pathlib.Path(stem + ".texture.jpg").exists()

    def state(self, name, k):
        return np.array(self.frames[k][name])[:, 0]

    def ring_means(self, points):
        """The stalk's centreline, from the tube around it."""
        sides, rings = self.dump["stalk_sides"], len(self.dump["radii"])
        return points[: rings * sides].reshape(rings, sides, 3).mean(axis=1)

    def stalk_near(self, points, k):
        centreline = placed(self.dump, self.frames[k]["stalk"])
        near(self.ring_means(points), centreline, 4 * np.abs(points).max())


def check_positions(sample, found, expected):
    """The largest error, which is within one rounding to float32 (or nine digits)."""
    near(found, expected, np.abs(expected).max())
    return np.abs(found - expected).max()


def check_pc2(sample):
    start, rate, samples = readers.pc2(sample.stem + ".pc2")
    assert start == 0 and len(samples) == len(sample.frames)
    even = np.linspace(0, sample.times[-1], len(samples))
    if len(samples) > 1:
        np.testing.assert_allclose(rate, FRAME_RATE * even[1], rtol=EPS)
    stacked = np.stack(sample.blade).reshape(len(samples), -1)
    expected = np.stack([np.interp(even, sample.times, column) for column in stacked.T], axis=1)
    error = check_positions(sample, samples, expected.reshape(samples.shape))
    if sample.has_stalk:
        stalk = readers.pc2(sample.stem + ".stalk.pc2")[2]
        for k in (0, len(samples) - 1):
            sample.stalk_near(stalk[k], k)
    return error


def check_mdd(sample):
    times, frames = readers.mdd(sample.stem + ".mdd")
    np.testing.assert_allclose(times, sample.times, rtol=EPS)
    if sample.has_stalk:
        for k, stalk in enumerate(readers.mdd(sample.stem + ".stalk.mdd")[1]):
            sample.stalk_near(stalk, k)
    return max(check_positions(sample, *pair) for pair in zip(frames, sample.blade, strict=True))


def check_ply(sample):
    errors = []
    for k, expected in enumerate(sample.blade):
        vertices, faces, comments = readers.ply(f"{sample.stem}.{k:04}.ply")
        size = len(sample.vertex)
        blade = vertices[:size]
        errors.append(check_positions(sample, readers.columns(blade, "x", "y", "z"), expected[sample.vertex]))
        near(readers.columns(blade, "nx", "ny", "nz"), normals_of(expected, sample.faces)[sample.vertex], 1.0)
        near(readers.columns(blade, "s", "t"), sample.uv * [1, -1] + [0, 1], 1.0)
        near(blade["dryness"].astype(float), sample.state("dryness", k)[sample.vertex], 1.0)
        np.testing.assert_array_equal(faces[: len(sample.faces)], sample.dump["skin"]["faces"])
        assert any(f"iteration: {sample.frames[k]['iteration']}" in comment for comment in comments)
        if not sample.textured:
            linear = np.array(sample.frames[k].get("colours", np.ones_like(expected)))[sample.vertex]
            assert np.abs(readers.columns(blade, "red", "green", "blue") - srgb(linear)).max() <= 1
        if sample.has_stalk:
            sample.stalk_near(readers.columns(vertices[size:], "x", "y", "z"), k)
            assert faces[len(sample.faces) :].min() == size and faces.max() == len(vertices) - 1
    return max(errors)


def check_obj_file(sample, path, k):
    found = readers.obj(path)
    size = len(sample.blade[k])
    # Nine digits of each number.
    error = np.abs(found["v"][:size] - sample.blade[k]).max()
    assert error <= 5e-9 * np.abs(sample.blade[k]).max(), error
    corners = found["objects"]["blade"]["faces"]
    np.testing.assert_array_equal(corners[:, :, 0], sample.faces)
    np.testing.assert_array_equal(corners[:, :, 1], sample.dump["skin"]["faces"])
    if sample.has_stalk:
        sample.stalk_near(found["v"][size:], k)
    materials = readers.mtl(pathlib.Path(path).parent / found["library"])
    assert {one["material"] for one in found["objects"].values()} <= set(materials)
    for one in materials.values():
        for key in {"map_Kd", "norm"} & set(one):
            assert (pathlib.Path(path).parent / one[key][0]).exists(), one[key]
    blade = materials[found["objects"]["blade"]["material"]]
    assert ("map_Kd" in blade) == sample.textured
    return error, blade


def check_obj(sample):
    results = [check_obj_file(sample, f"{sample.stem}_all.{k:04}.obj", k) for k in range(len(sample.frames))]
    last, _ = check_obj_file(sample, sample.stem + ".obj", len(sample.frames) - 1)
    if sample.textured:  # a texture of its own for every frame
        assert len({blade["map_Kd"][0] for _, blade in results}) == len(results)
    return max([last] + [error for error, _ in results])


def grid(path):
    """(points, triangles, {name: point or cell data}, {name: number}) by VTK's own reader."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    result = reader.GetOutput()
    cells = vtk_to_numpy(result.GetCells().GetConnectivityArray()).reshape(-1, 3)
    assert result.GetNumberOfCells() == len(cells) and result.GetCellType(0) == 5
    data = {}
    for part in (result.GetPointData(), result.GetCellData(), result.GetFieldData()):
        data |= {part.GetArrayName(i): vtk_to_numpy(part.GetArray(i)) for i in range(part.GetNumberOfArrays())}
    return vtk_to_numpy(result.GetPoints().GetData()).astype(float), cells, data


def areas(points, faces):
    sides = points[faces[:, 1:]] - points[faces[:, :1]]
    return np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2


def check_grid(sample, path, k):
    points, faces, data = grid(path)
    error = check_positions(sample, points, sample.blade[k])
    np.testing.assert_array_equal(faces, sample.faces)
    scale = np.abs(sample.blade[k]).max()
    near(data["Normals"], normals_of(sample.blade[k], sample.faces), 1.0)
    near(data["displacement"], sample.blade[k] - sample.blade[0], scale)
    near(data["dryness"], sample.state("dryness", k), 1.0)
    if sample.frames[k]["water"]:
        near(data["water"], sample.state("water", k), 1.0)
    ratio = areas(sample.blade[k], sample.faces) / areas(sample.blade[0], sample.faces)
    near(data["area_ratio"], ratio, ratio.max())
    np.testing.assert_allclose(data["TimeValue"], HOURS_PER_ITERATION * sample.iterations[k])
    np.testing.assert_allclose(data["metres_per_unit"], 1 / sample.dump["scale"])
    assert data["colour"].dtype == np.uint8
    if not sample.textured:
        linear = np.array(sample.frames[k].get("colours", np.ones_like(points)))
        assert np.abs(data["colour"] - srgb(linear)).max() <= 1
    return error


def check_vtk(sample):
    entries = readers.pvd(sample.stem + ".pvd")
    blades = [(time, path) for time, part, path in entries if part == 0]
    np.testing.assert_allclose([time for time, _ in blades], HOURS_PER_ITERATION * sample.iterations)
    stalks = [path for _, part, path in entries if part == 1]
    assert len(stalks) == (len(blades) if sample.has_stalk else 0)
    for k, path in enumerate(stalks):
        sample.stalk_near(grid(path)[0], k)
    errors = [check_grid(sample, path, k) for k, (_, path) in enumerate(blades)]
    return max([check_grid(sample, sample.stem + ".vtu", len(blades) - 1)] + errors)


def check(stem):
    sample = Sample(stem)
    checks = [("PC2", "own, numpy", check_pc2), ("MDD", "own, numpy", check_mdd), ("PLY", "own, numpy", check_ply),
              ("OBJ + MTL", "own, numpy", check_obj)]
    if vtkXMLUnstructuredGridReader:
        checks.append(("VTU + PVD", "VTK", check_vtk))
    for name, reader, run in checks:
        print(f"{pathlib.Path(stem).name}: {name:10} {reader:11} {len(sample.frames)} frames, largest error of a "
              f"position {run(sample):.1e} of {np.abs(sample.blade).max():.3g}")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        check(name)
    if not vtkXMLUnstructuredGridReader:
        print("no VTU was read: VTK's Python is not installed (python3-vtk9)")
