"""Readers of the formats that wilt writes, from the formats' descriptions; none shares code with wilt.

Each gives what stands in a file as numpy arrays, positions as float64 in the coordinates of the file.
"""
import pathlib
import struct
import xml.etree.ElementTree

import numpy as np


def pc2(path):
    """(start, frames per sample, samples x points x 3); Autodesk's POINTCACHE2."""
    data = pathlib.Path(path).read_bytes()
    magic, version, points, start, rate, samples = struct.unpack_from("<12siiffi", data)
    assert (magic, version) == (b"POINTCACHE2\0", 1) and len(data) == 32 + 12 * points * samples
    return start, rate, np.frombuffer(data, "<f4", offset=32).reshape(samples, points, 3).astype(float)


def mdd(path):
    """(times in seconds, frames x points x 3); LightWave's Motion Designer."""
    data = pathlib.Path(path).read_bytes()
    frames, points = struct.unpack_from(">ii", data)
    assert len(data) == 8 + 4 * frames + 12 * points * frames
    times = np.frombuffer(data, ">f4", frames, 8).astype(float)
    return times, np.frombuffer(data, ">f4", offset=8 + 4 * frames).reshape(frames, points, 3).astype(float)


PLY_TYPES = {"float": "<f4", "uchar": "u1", "int": "<i4"}


def ply(path):
    """(vertices as a structured array, faces, comments) of a binary PLY of triangles."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    counts, fields, comments = {}, [], []
    for words in (line.split() for line in lines[2:]):
        if words[0] == "comment":
            comments.append(" ".join(words[1:]))
        elif words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[0] == "property" and words[1] != "list":
            fields.append((words[2], PLY_TYPES[words[1]]))
    assert "property list uchar int vertex_indices" in lines
    vertices = np.frombuffer(data, np.dtype(fields), counts["vertex"], end)
    faces = np.frombuffer(data, np.dtype([("count", "u1"), ("corners", "<i4", 3)]), offset=end + vertices.nbytes)
    assert len(faces) == counts["face"] and (faces["count"] == 3).all()
    return vertices, faces["corners"], comments


def columns(vertices, *names):
    return np.stack([vertices[name].astype(float) for name in names], axis=1)


def obj(path):
    """{"v", "vt", "vn": rows; objects: {name: {"faces": (corners of v, vt, vn from 0), "material"}}; "library"}."""
    rows = {"v": [], "vt": [], "vn": []}
    objects, library, current = {}, None, None
    for words in (line.split() for line in pathlib.Path(path).read_text().splitlines()):
        if not words or words[0] == "#":
            continue
        if words[0] in rows:
            rows[words[0]].append([float(word) for word in words[1:]])
        elif words[0] == "o":
            current = objects.setdefault(words[1], {"faces": [], "material": None})
        elif words[0] == "usemtl":
            current["material"] = words[1]
        elif words[0] == "mtllib":
            library = words[1]
        else:
            assert words[0] == "f" and len(words) == 4, words
            current["faces"].append([[int(part or 0) - 1 for part in word.split("/")] for word in words[1:]])
    for one in objects.values():
        one["faces"] = np.array(one["faces"])
    return {**{key: np.array(value) for key, value in rows.items()}, "objects": objects, "library": library}


def mtl(path):
    """{material: {keyword: words}}."""
    materials = {}
    for words in (line.split() for line in pathlib.Path(path).read_text().splitlines()):
        if words and words[0] == "newmtl":
            current = materials.setdefault(words[1], {})
        elif words and words[0] != "#":
            current[words[0]] = words[1:]
    return materials


def pvd(path):
    """[(time, part, path of the grid)] in the order of the file."""
    folder = pathlib.Path(path).parent
    return [(float(item.get("timestep")), int(item.get("part")), folder / item.get("file"))
            for item in xml.etree.ElementTree.parse(path).getroot().iter("DataSet")]
