"""Good leaf files of every kind, small, and ways to spoil them. Everything is seeded: a case is the same each time."""
import base64
import json
import math
import random
import struct
import subprocess
import zlib

COLUMNS, ROWS = 6, 10


def sheet(columns=COLUMNS, rows=ROWS, scale=1.0):
    """Points (x, y up, z) and quadrilaterals of an arched trapezium, some 10 cm long, its base at z = 0."""
    points, quads = [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            s, t = i / columns, j / rows
            points.append(tuple(scale * c for c in ((0.5 + (s - 0.5) * (1 - 0.6 * t)) * 0.06, 0.01 * t * t, t * 0.1)))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            quads.append((a, a + columns + 1, a + columns + 2, a + 1))
    return points, quads


def triangles(quads):
    return [t for q in quads for k in range(1, len(q) - 1) for t in [(q[0], q[k], q[k + 1])]]


def obj(points, faces):
    lines = ["v " + " ".join(map(repr, p)) for p in points]
    return "\n".join(lines + ["f " + " ".join(str(i + 1) for i in f) for f in faces] + [""]).encode()


def ply_head(kind, vertices, faces):
    return (f"ply\nformat {kind} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n").encode()


def ply(points, faces):
    lines = [" ".join(map(repr, p)) for p in points] + [" ".join(map(str, (len(f), *f))) for f in faces]
    return ply_head("ascii", len(points), len(faces)) + "\n".join(lines + [""]).encode()


def floats(points):
    return b"".join(struct.pack("<3f", *p) for p in points)


def ply_binary(points, faces):
    return (ply_head("binary_little_endian", len(points), len(faces)) + floats(points)
            + b"".join(struct.pack(f"<B{len(f)}i", len(f), *f) for f in faces))


def stl(points, faces):
    text = "solid leaf\n"
    for face in triangles(faces):
        corners = "".join(f"vertex {points[i][0]!r} {points[i][1]!r} {points[i][2]!r}\n" for i in face)
        text += f"facet normal 0 1 0\nouter loop\n{corners}endloop\nendfacet\n"
    return (text + "endsolid leaf\n").encode()


def stl_binary(points, faces, count=None):
    all_triangles = triangles(faces)
    head = b"leaf".ljust(80, b" ") + struct.pack("<I", len(all_triangles) if count is None else count)
    return head + b"".join(struct.pack("<3f", 0, 1, 0) + floats(points[i] for i in t) + b"\0\0" for t in all_triangles)


def gltf_parts(points, faces):
    """The document without its buffer, and the buffer."""
    indices = [i for t in triangles(faces) for i in t]
    buffer = floats(points) + struct.pack(f"<{len(indices)}I", *indices)
    size = 12 * len(points)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": size},
                        {"buffer": 0, "byteOffset": size, "byteLength": 4 * len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
                       "min": [-1e9] * 3, "max": [1e9] * 3},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}]}
    return document, buffer


def gltf(document, buffer):
    uri = "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()
    return json.dumps({**document, "buffers": [{"uri": uri, "byteLength": len(buffer)}]}).encode()


def glb(document, buffer):
    text = json.dumps({**document, "buffers": [{"byteLength": len(buffer)}]}).encode()
    text += b" " * (-len(text) % 4)
    buffer += b"\0" * (-len(buffer) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(buffer)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer)


def margin(count=60, size=100.0):
    """A pointed oval with its base at the origin, y up."""
    return [(size * 0.35 * math.sin(2 * math.pi * k / count) * (1.2 - 0.5 * (1 - math.cos(2 * math.pi * k / count))),
             size * (1 - math.cos(2 * math.pi * k / count)) / 2) for k in range(count)]


def outline(ring, holes=(), **more):
    return json.dumps({"outline": ring, **({"holes": holes} if holes else {}), **more}).encode()


def svg(*rings, head='viewBox="-50 -110 100 120"', rule="evenodd"):
    path = "".join("M" + " ".join(f"{x!r},{-y!r}" for x, y in ring) + "Z" for ring in rings)
    return f'<svg xmlns="http://www.w3.org/2000/svg" {head}><path fill-rule="{rule}" fill="green" d="{path}"/></svg>'.encode()


def png_chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png_of(width, height, packed, depth=8, colour=2):
    """A PNG whose pixels are `packed`, compressed already."""
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0))
            + png_chunk(b"IDAT", packed) + png_chunk(b"IEND", b""))


def png(size=160):
    """A green leaf on white."""
    rows = bytearray()
    for y in range(size):
        rows.append(0)
        for x in range(size):
            s, t = (x - size / 2) / (0.3 * size), (y - size / 2) / (0.42 * size)
            rows += bytes((60, 130, 40)) if abs(s) ** 1.5 + abs(t) ** 1.5 < 1 else bytes((240, 240, 238))
    return png_of(size, size, zlib.compress(bytes(rows)))


def jpeg(picture):
    command = ["ffmpeg", "-v", "error", "-f", "png_pipe", "-i", "-", "-f", "mjpeg", "-"]
    return subprocess.run(command, input=picture, stdout=subprocess.PIPE, check=True).stdout


def xyz(separator=" ", scale=100.0, count=4000):
    """Points of an oval leaf, z up."""
    rng, lines = random.Random(5), []
    while len(lines) < count:
        s, t = rng.uniform(-1, 1), rng.uniform(-1, 1)
        if abs(s) ** 1.5 + abs(t) ** 1.5 < 1:
            lines.append(separator.join(repr(scale * c) for c in (0.3 * s, 0.5 * t, 0.03 * s * s + 0.02 * t)))
    return ("\n".join(lines) + "\n").encode()


def good_files():
    """A small good file of every kind, by its extension (or by a word where an extension has two kinds)."""
    points, quads = sheet()
    parts = gltf_parts(points, quads)
    picture = png()
    return {".obj": obj(points, quads), ".ply": ply(points, quads), "binary.ply": ply_binary(points, quads),
            ".stl": stl(points, quads), "binary.stl": stl_binary(points, quads), ".glb": glb(*parts), ".gltf": gltf(*parts),
            ".svg": svg(margin()), ".json": outline(margin()), ".png": picture, ".jpg": jpeg(picture),
            ".xyz": xyz(), ".txt": xyz("\t"), ".csv": b"x,y,z\n" + xyz(",")}


def meshes(points, faces):
    """One surface in every format that can hold it."""
    document, buffer = gltf_parts(points, faces)
    return {".obj": obj(points, faces), ".ply": ply(points, faces), "binary.ply": ply_binary(points, faces),
            "binary.stl": stl_binary(points, faces), ".glb": glb(document, buffer)}


def noise(size, seed):
    return random.Random(seed).randbytes(size)


def flipped(data, seed, share=0.002):
    """Some bytes changed."""
    rng, changed = random.Random(seed), bytearray(data)
    for _ in range(max(1, int(share * len(data)))):
        changed[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(changed)
