"""An independent reader of GLB: compares what stands in a file with what went into it.

Oracle: the leaf-frame data beside each GLB, brought into the file's coordinates by formulas that are written
here again. Usage: check_glb.py FILE.glb ... (with FILE.json beside it)
"""
import itertools
import json
import pathlib
import struct
import sys

import numpy as np

EPS = float(np.finfo(np.float32).eps)
TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


class Glb:
    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and size % 4 == 0
        self.json = json.loads(data[20 : 20 + size])
        binary_size, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0" and binary_size % 4 == 0 and 28 + size + binary_size == len(data)
        self.binary = data[28 + size :]

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        count, width = accessor["count"], WIDTHS[accessor["type"]]
        if "bufferView" in accessor:
            values = self.array(accessor, accessor["componentType"], count * width).reshape(count, width)
        else:
            values = np.zeros((count, width), TYPES[accessor["componentType"]])
        if sparse := accessor.get("sparse"):
            rows = self.array(sparse["indices"], sparse["indices"]["componentType"], sparse["count"])
            assert np.all(np.diff(rows.astype(int)) > 0)
            packed = self.array(sparse["values"], accessor["componentType"], sparse["count"] * width)
            values[rows] = packed.reshape(-1, width)
        if "min" in accessor:
            np.testing.assert_array_equal(values.min(axis=0), np.array(accessor["min"], np.float32))
            np.testing.assert_array_equal(values.max(axis=0), np.array(accessor["max"], np.float32))
        return values.astype(np.float64)

    def array(self, place, kind, count):
        view = self.json["bufferViews"][place["bufferView"]]
        start = view.get("byteOffset", 0) + place.get("byteOffset", 0)
        assert start % 4 == 0 and "byteStride" not in view
        end = view.get("byteOffset", 0) + view["byteLength"]
        assert start + count * np.dtype(TYPES[kind]).itemsize <= end <= len(self.binary)
        return np.frombuffer(self.binary[start:end], TYPES[kind], count)

    def attribute(self, primitive, name):
        return self.accessor(primitive["attributes"][name])

    def frames(self, primitive, name):
        base = self.attribute(primitive, name)
        return [base + self.accessor(t[name]) for t in primitive.get("targets", []) if name in t] or [base]


def y_up(points):
    return np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1)


def placed(dump, points):
    rotation = np.array(dump["rotation"])
    return y_up(dump["scale"] * np.array(points) @ rotation.T + np.array(dump["translation"]))


def normals_of(points, faces):
    normals = np.zeros_like(points)
    cross = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    for corner in range(3):
        np.add.at(normals, faces[:, corner], cross)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def near(found, expected, scale):
    """Two roundings to float32, of the base and of the difference, each half an eps of the largest value."""
    assert found.shape == expected.shape, (found.shape, expected.shape)
    error = np.abs(found - expected).max()
    assert error <= EPS * scale, f"error {error:.3g} above {EPS * scale:.3g}"


def check_blade(glb, dump, mesh):
    (primitive,) = mesh["primitives"]
    skin, faces = dump["skin"], np.array(dump["mesh_faces"])
    vertex = np.array(skin["vertex"])
    indices = glb.accessor(primitive["indices"]).reshape(-1, 3)
    np.testing.assert_array_equal(indices, skin["faces"])
    near(glb.accessor(primitive["attributes"]["TEXCOORD_0"]), np.array(skin["uv"]), 1.0)
    positions, normals = glb.frames(primitive, "POSITION"), glb.frames(primitive, "NORMAL")
    assert len(positions) == len(normals) == len(dump["frames"])
    for k, frame in enumerate(dump["frames"]):
        expected = placed(dump, frame["positions"])
        near(positions[k], expected[vertex], np.abs(expected).max())
        near(normals[k], normals_of(expected, faces)[vertex], 2.0)
        np.testing.assert_allclose(np.linalg.norm(normals[k], axis=1), 1.0, atol=4 * EPS)
        if "colours" in frame:
            near(glb.frames(primitive, "COLOR_0")[k], np.asarray(frame["colours"])[vertex], 1.0)
    # A reader without colour morphs shows the last colours; one that does not animate shows the last frame.
    base = placed(dump, dump["frames"][0]["positions"])[vertex]
    near(glb.accessor(primitive["attributes"]["POSITION"]), base, np.abs(base).max())
    if "colours" in dump["frames"][-1]:
        last = np.asarray(dump["frames"][-1]["colours"])[vertex]
        near(glb.accessor(primitive["attributes"]["COLOR_0"]), last, 1.0)
    if len(dump["frames"]) > 1:
        assert not np.any(glb.accessor(primitive["targets"][0]["POSITION"]))
        assert mesh["weights"] == [0] * (len(dump["frames"]) - 1) + [1]
    else:
        assert "targets" not in primitive and "weights" not in mesh
    water = np.array(dump["frames"][-1]["water"])
    assert ("_WATER" in primitive["attributes"]) == (len(water) > 0)
    if len(water):
        near(glb.accessor(primitive["attributes"]["_WATER"]), water[vertex], 1.0)


def check_stalk(glb, dump, mesh):
    """Every ring: its mean is the centreline's point, its corners are a radius away, its normals radial."""
    (primitive,) = mesh["primitives"]
    sides, radii = dump["stalk_sides"], dump["scale"] * np.array(dump["radii"])
    faces = glb.accessor(primitive["indices"]).reshape(-1, 3).astype(int)
    normals = glb.frames(primitive, "NORMAL")
    for k, points in enumerate(glb.frames(primitive, "POSITION")):
        centreline = placed(dump, dump["frames"][k]["stalk"])
        scale = np.abs(centreline).max() + radii.max()
        rings = points[: len(radii) * sides].reshape(len(radii), sides, 3)
        near(rings.mean(axis=1), centreline, 2 * scale)
        across = rings - centreline[:, None]
        near(np.linalg.norm(across, axis=2), np.repeat(radii[:, None], sides, axis=1), 2 * scale)
        radial = across / radii[:, None, None]
        near(normals[k][: len(radii) * sides].reshape(rings.shape), radial, 4 * scale / radii.min())
        # A closed surface that is oriented outwards has the volume of its rings' prisms, above zero.
        a, b, c = (points[faces[:, i]] - centreline[0] for i in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        length = np.linalg.norm(np.diff(centreline, axis=0), axis=1).sum()
        assert 0.5 < volume / (np.pi * np.mean(radii) ** 2 * length) < 1.1, volume
        if "stalk_colour" in dump["frames"][k]:
            colours = glb.frames(primitive, "COLOR_0")[k]
            near(colours, np.repeat(np.asarray(dump["frames"][k]["stalk_colour"]), len(points), axis=0), 1.0)


def check_animation(glb, dump):
    frames = dump["frames"]
    if len(frames) == 1:
        assert "animations" not in glb.json
        return
    (animation,) = glb.json["animations"]
    nodes = {c["target"]["node"] for c in animation["channels"] if c["target"]["path"] == "weights"}
    assert nodes == set(range(len(glb.json["nodes"])))
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        assert sampler["interpolation"] == "LINEAR"
        iterations = np.array([[frame["iteration"]] for frame in frames])
        near(glb.accessor(sampler["input"]), dump["seconds"] * iterations / iterations[-1], dump["seconds"])
        weights = glb.accessor(sampler["output"]).reshape(len(frames), len(frames))
        np.testing.assert_array_equal(weights, np.eye(len(frames)))


def check_choice(extras, dump):
    """Leaves the kept frames in the dump; of all choices of as many, theirs misses the least by brute force."""
    times = np.array([frame["iteration"] for frame in dump["frames"]])
    shapes = np.array([frame["positions"] + frame["stalk"] for frame in dump["frames"]])

    def deviations(kept):
        played = [[np.interp(times, times[kept], track) for track in vertex] for vertex in shapes[kept].transpose(1, 2, 0)]
        return np.linalg.norm(np.array(played).transpose(2, 0, 1) - shapes, axis=2)

    kept = [list(times).index(iteration) for iteration in extras["frames"]]
    missed = deviations(kept)
    assert np.isclose(missed.max(), extras["left_out"]["largest"], rtol=1e-6)
    assert np.isclose(np.sqrt(np.mean(missed**2)), extras["left_out"]["rms"], rtol=1e-6)
    assert extras["left_out"]["of"] == len(times)
    between = itertools.combinations(range(1, len(times) - 1), len(kept) - 2)
    assert all(np.sum(missed**2) <= np.sum(deviations([0, *some, len(times) - 1]) ** 2) for some in between)
    dump["frames"] = [dump["frames"][k] for k in kept]


def check(path):
    glb, dump = Glb(path), json.load(open(path[:-4] + ".json"))
    extras = glb.json["asset"]["extras"]["wilt"]
    if "left_out" in extras:
        check_choice(extras, dump)
    meshes = {node["name"]: glb.json["meshes"][node["mesh"]] for node in glb.json["nodes"]}
    assert ("stalk" in meshes) == (len(dump["frames"][0]["stalk"]) > 0)
    check_blade(glb, dump, meshes["blade"])
    if "stalk" in meshes:
        check_stalk(glb, dump, meshes["stalk"])
    check_animation(glb, dump)
    assert extras["up"] == "Y" and extras["frames"] == [frame["iteration"] for frame in dump["frames"]]
    for vein in extras["veins"]:
        faces = np.array(dump["mesh_faces"])[vein["faces"]]
        rest = placed(dump, dump["frames"][0]["positions"])
        expected = np.einsum("pc,pcx->px", np.array(vein["barycentric"]), rest[faces])
        # Nine decimals of a position, and of coordinates that weigh positions.
        np.testing.assert_allclose(vein["positions"], expected, atol=5e-9 * (1 + np.abs(rest).max()))
    print(f"{path}: {len(dump['frames'])} frames, {len(meshes)} meshes, {len(extras['veins'])} veins agree")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        check(name)
