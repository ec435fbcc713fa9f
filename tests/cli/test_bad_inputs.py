"""Bad files at every reader: each is read, with every number of the result finite, or refused with a message that names it.

Never a signal, a C++ exception's text, a wait without end, or more memory than MEMORY. Oracles: the contract of the exit
codes, Python's JSON and text as readers of the results, the operating system's word on how the program ended. Prints how
many cases of each kind were read and refused; --messages prints every message, for reading.
"""
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import resource
import stat
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import bad_files as files

WILT = os.path.abspath(sys.argv.pop(1))
SHOW = "--messages" in sys.argv and not sys.argv.remove("--messages")
MEMORY = 3 << 30  # bytes of addresses; Embree and oneTBB map some
HANGS = 300       # seconds; nothing here takes more than a few
TABLE = collections.defaultdict(collections.Counter)
GOOD = files.good_files()


def extension(key):
    return "." + key.rsplit(".", 1)[1]


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def wilt(*arguments, **options):
    return subprocess.run([WILT, *arguments], stdin=subprocess.DEVNULL, capture_output=True, timeout=HANGS,
                          preexec_fn=limited, **options)


def all_finite(value):
    if isinstance(value, dict):
        return all(map(all_finite, value.values()))
    if isinstance(value, list):
        return all(map(all_finite, value))
    return value is not None and (not isinstance(value, float) or math.isfinite(value))


class Cases(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def judge(self, kind, case, result, codes, name, says):
        """The contract that every case keeps."""
        words = result.stderr.decode()  # valid UTF-8, whatever the file is called
        if SHOW:
            print(f"{kind} / {case}: {result.returncode}\n    " + words.strip().replace("\n", "\n    "))
        where = f"{kind} / {case}: {words[-600:]}"
        self.assertIn(result.returncode, codes, where)
        for trace in ("terminate called", "json.exception", "std::", "basic_string", "bad_alloc", "what()"):
            self.assertNotIn(trace, words, where)
        if result.returncode != 0:
            error = words.strip().splitlines()[-1]
            self.assertTrue(error.startswith("error: "), where)
            self.assertFalse(error.endswith("."), where)
            self.assertLess(len(error), 700, where)
            self.assertIn(name, words, where)
            self.assertEqual(result.stdout, b"", where)
        self.assertIn(says, words, where)
        TABLE[kind][result.returncode] += 1

    def read(self, kind, case, key, data, codes=(0, 3), says="", beside=()):
        """`wilt leaf` on a file of these bytes."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.dir))
        path, out = folder / ("bad" + extension(key)), folder / "out.obj"
        path.write_bytes(data)
        for name, content in beside:
            (folder / name).write_bytes(content)
        result = wilt("leaf", path, "-o", out, "--json")
        self.judge(kind, f"{case} {key}", result, codes, path.name, says)
        if result.returncode == 0:
            summary = json.loads(result.stdout)
            self.assertTrue(all_finite(summary), summary)
            numbers = [float(word) for line in out.read_text().splitlines() if line[:2] in ("v ", "vt")
                       for word in line.split()[1:]]
            self.assertTrue(numbers and all(map(math.isfinite, numbers)), f"{kind} / {case}")
        else:
            self.assertFalse(out.exists(), f"{kind} / {case}")

    def read_all(self, kind, cases, **options):
        """Of (case, extension, bytes), two at a time."""
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            wrong = [done.exception() for done in [pool.submit(self.read, kind, *case, **options) for case in cases]]
        self.assertEqual([], [str(problem) for problem in wrong if problem])

    def read_surfaces(self, kind, surfaces, **options):
        """Of {case: (points, faces)}, in every mesh format."""
        self.read_all(kind, [(case, key, data) for case, surface in surfaces.items()
                             for key, data in files.meshes(*surface).items()], **options)


class Content(Cases):
    """What may stand in a file of any kind."""

    def test_good_files_are_read(self):
        self.read_all("good", [("as it is", key, data) for key, data in GOOD.items()], codes=(0,))

    def test_empty_files_are_refused(self):
        self.read_all("empty", [("0 bytes", key, b"") for key in GOOD] + [("a blank line", key, b"\n") for key in GOOD],
                      codes=(3,))

    def test_truncated(self):
        self.read_all("truncated", [(f"{cut} of {len(data)}", key, data[:cut]) for key, data in GOOD.items()
                                    for cut in (1, 11, len(data) // 3, 2 * len(data) // 3, len(data) - 3)])

    def test_noise(self):
        cases = [("noise", key, files.noise(size, size)) for key in GOOD for size in (100, 30000)]
        cases += [("noise behind a good beginning", key, data[:60] + files.noise(3000, 7)) for key, data in GOOD.items()]
        cases += [(f"changed bytes, seed {seed}", key, files.flipped(data, seed)) for key, data in GOOD.items()
                  for seed in range(3)]
        self.read_all("noise", cases)

    def test_wrong_extension(self):
        cases = []
        for key, data in GOOD.items():
            named = [".obj", ".ply", ".stl", ".glb", ".gltf", ".svg", ".json", ".png", ".xyz"]
            cases += [(f"{key} called", other, data) for other in named if other != extension(key)
                      and (key not in (".txt", ".csv", ".jpg") or other in (".obj", ".png"))]
        self.read_all("wrong extension", cases)


class Counts(Cases):
    def test_absurd_counts(self):
        points, quads = files.sheet()
        document, buffer = files.gltf_parts(points, quads)

        def changed(path, value):
            copy = json.loads(json.dumps(document))
            place = copy
            for step in path[:-1]:
                place = place[step]
            place[path[-1]] = value
            return copy

        many = 4_000_000_000
        cases = [("4e9 vertices", ".ply", files.ply_head(kind, many, 10) + b"0 0 0\n" * 5)
                 for kind in ("ascii", "binary_little_endian", "binary_big_endian")]
        cases += [("4e9 faces", ".ply", files.ply_head(kind, 3, many) + files.floats(points[:3]))
                  for kind in ("ascii", "binary_little_endian")]
        cases += [("a list of 255 without them", ".ply", files.ply_head("binary_little_endian", 3, 1)
                   + files.floats(points[:3]) + b"\xff\0\0\0\0"),
                  ("-1 vertices", ".ply", files.ply_head("ascii", -1, -1)),
                  ("4e9 triangles", ".stl", files.stl_binary(points[:4], [(0, 1, 2)], many)),
                  ("0 triangles", ".stl", files.stl_binary(points, quads, 0)),
                  ("longer than it is", ".glb", GOOD[".glb"][:8] + struct.pack("<I", many) + GOOD[".glb"][12:]),
                  ("a longer chunk", ".glb", GOOD[".glb"][:12] + struct.pack("<I", many) + GOOD[".glb"][16:])]
        for path, value in ((("accessors", 0, "count"), many), (("accessors", 1, "count"), many),
                            (("accessors", 0, "count"), -1), (("accessors", 0, "byteOffset"), many),
                            (("bufferViews", 0, "byteLength"), many), (("bufferViews", 0, "byteStride"), 2 ** 31),
                            (("bufferViews", 0, "byteOffset"), 2 ** 63), (("accessors", 0, "count"), 1e300),
                            (("accessors", 0, "bufferView"), 99), (("accessors", 1, "sparse"), {
                                "count": many, "indices": {"bufferView": 1, "componentType": 5125},
                                "values": {"bufferView": 0}}),
                            (("nodes", 0, "children"), [0]), (("nodes", 0, "mesh"), 7), (("meshes",), []),
                            (("scenes", 0, "nodes"), [0] * 100000),
                            (("accessors", 0, "type"), "MAT9"), (("accessors", 0, "componentType"), 1)):
            name = f"{'.'.join(map(str, path))} = {str(value)[:30]}"
            cases += [(name, ".glb", files.glb(changed(path, value), buffer)),
                      (name, ".gltf", files.gltf(changed(path, value), buffer))]
        doubling = [{"children": [i + 1, i + 1]} for i in range(40)] + [{"mesh": 0}]
        cases.append(("nodes that double 40 times", ".glb", files.glb(changed(("nodes",), doubling), buffer)))
        self.read_all("absurd counts", cases)

    def test_pictures_that_are_larger_than_their_file(self):
        zeros = zlib.compress(bytes(30000 * 30001 // 8), 9)
        jpeg = bytearray(GOOD[".jpg"])
        at = next(i for i in range(len(jpeg)) if jpeg[i:i + 2] in (b"\xff\xc0", b"\xff\xc2"))
        jpeg[at + 5:at + 9] = b"\xff\xff\xff\xff"
        cases = [("65535 x 65535", ".png", files.png_of(65535, 65535, zlib.compress(b"\0" * 100))),
                 ("2^31 - 1 wide", ".png", files.png_of(2 ** 31 - 1, 1, zlib.compress(b"\0" * 100))),
                 ("0 x 0", ".png", files.png_of(0, 0, b"")),
                 ("30000 x 30000 zeros", ".png", files.png_of(30000, 30000, zeros, 1, 0)),
                 ("12000 x 12000 without pixels", ".png", files.png_of(12000, 12000, b"")),
                 ("65535 x 65535", ".jpg", bytes(jpeg))]
        self.read_all("decompression bombs", cases, codes=(3,))

    def test_deep_and_long(self):
        deep = 1_000_000
        cases = [("deep arrays", ".json", b"[" * deep), ("deep outline", ".json", b'{"outline": ' + b"[" * deep),
                 ("deep closed outline", ".json", b'{"outline": ' + b"[" * deep + b"]" * deep + b"}"),
                 ("deep groups", ".svg", b'<svg xmlns="http://www.w3.org/2000/svg">' + b"<g>" * 300000),
                 ("deep closed groups", ".svg", b'<svg xmlns="http://www.w3.org/2000/svg">' + b"<g>" * 300000
                  + b"</g>" * 300000 + b"</svg>"),
                 ("deep JSON", ".gltf", b'{"asset": {"version": "2.0"}, "extras": ' + b"[" * deep + b"]" * deep + b"}")]
        text = b'{"asset": {"version": "2.0"}, "extras": ' + b"[" * deep + b"]" * deep + b"}  "
        text += b" " * (-len(text) % 4)
        cases.append(("deep JSON", ".glb", struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text), len(text), b"JSON") + text))
        cases += [("a line of 2e6 characters", key, b"v " + b"1 " * 1_000_000) for key in (".obj", ".xyz", ".csv", ".stl")]
        cases += [("a number of 1e6 digits", key, b"v " + b"1" * 1_000_000 + b" 0 0\n") for key in (".obj", ".xyz")]
        cases += [("a path of 1e6 numbers", ".svg", files.svg([(k % 7, k % 11) for k in range(100000)]))]
        self.read_all("deep and long", cases)


class Geometry(Cases):
    def test_not_finite(self):
        points, quads = files.sheet()
        surfaces = {}
        for value in (math.nan, math.inf, -math.inf):
            surfaces[str(value)] = [(value, 0, 0)] + points[1:], quads
        surfaces["1e39"] = [(1e39, 0, 0)] + points[1:], quads
        cases = [(case, key, data) for case, surface in surfaces.items() if case != "1e39"
                 for key, data in files.meshes(*surface).items()]
        cases += [("1e39", ".obj", files.obj(*surfaces["1e39"])), ("1e39", ".ply", files.ply(*surfaces["1e39"]))]
        for word in ("NaN", "Infinity", "-Infinity", "1e999", "null", '"1"'):
            text = GOOD[".json"].decode()
            cases.append((word, ".json", text.replace("[0.0, 0.0]", f"[{word}, 0.0]", 1).encode()))
        for word in ("nan", "inf", "1e999"):
            cases.append((word, ".svg", GOOD[".svg"].replace(b"M0.0,", b"M" + word.encode() + b",")))
            cases.append((f"viewBox {word}", ".svg", files.svg(files.margin(), head=f'viewBox="0 0 {word} 9" width="9cm"')))
        for word in ("matrix(0 0 0 0 0 0)", "scale(1e308)", "scale(1e-320)", "rotate(1e999)"):
            cases.append((word, ".svg", GOOD[".svg"].replace(b"<path", f'<path transform="{word}"'.encode())))
        self.read_all("not finite", cases, codes=(0, 3))
        lines = GOOD[".xyz"].splitlines()
        self.read_all("not finite", [("3 of 4000 points nan", ".xyz", b"\n".join([b"nan nan nan"] * 3 + lines)),
                                     ("a point inf", ".csv", b"\n".join([b"inf 0 0"] + lines))], codes=(0,), says="left out")
        self.read_all("not finite", [("all nan", ".xyz", b"nan nan nan\n" * 500)], codes=(3,))

    def test_scales(self):
        points, quads = files.sheet()
        for power in (-300, -30, -9, -6, -3, 3, 6, 9, 15, 37):
            scale = 10.0 ** power
            scaled = [tuple(scale * c for c in p) for p in points]
            cases = [(f"1e{power}", key, data) for key, data in files.meshes(scaled, quads).items()]
            ring = [tuple(scale * c for c in p) for p in files.margin()]
            head = f'viewBox="{-50 * scale!r} {-110 * scale!r} {100 * scale!r} {120 * scale!r}"'
            cases += [(f"1e{power}", ".json", files.outline(ring)), (f"1e{power}", ".svg", files.svg(ring, head=head)),
                      (f"1e{power}", ".xyz", files.xyz(scale=100 * scale))]
            usual = -9 <= power <= 9
            self.read_all("scales 1e-9 to 1e9" if usual else "scales beyond", cases, codes=(0,) if usual else (0, 3))
        far = [(x + 1e6, y, z) for x, y, z in points]
        self.read_surfaces("far from the origin", {"1e6 away": (far, quads)})

    def test_indices(self):
        points, quads = files.sheet()
        surfaces = {"beyond": (points, quads + [(0, 1, len(points))]), "far beyond": (points, quads + [(0, 1, 2 ** 31 - 1)])}
        cases = []
        for case, surface in surfaces.items():
            document, buffer = files.gltf_parts(points, quads)
            wrong = buffer[:-4] + struct.pack("<I", surface[1][-1][-1])
            cases += [(case, ".obj", files.obj(*surface)), (case, ".ply", files.ply(*surface)),
                      (case, "binary.ply", files.ply_binary(*surface)), (case, ".glb", files.glb(document, wrong)),
                      (case, ".gltf", files.gltf(document, wrong))]
        for word in ("0", "-1000", "99999999999999999999", "1.5", "x", "1/9/9", "1//99"):
            cases.append((word, ".obj", files.obj(points, quads) + f"f 1 2 {word}\n".encode()))
        cases += [("negative", ".ply", files.ply(points, quads + [(0, 1, -5)])),
                  ("negative", "binary.ply", files.ply_binary(points, quads + [(0, 1, -5)])),
                  ("a face of 2", ".ply", files.ply(points, quads + [(0, 1)])),
                  ("a face of 0", ".ply", files.ply(points, quads + [()])),
                  ("a face of 2", ".obj", files.obj(points, quads + [(0, 1)]))]
        self.read_all("indices out of range", cases)

    def test_surfaces_that_are_no_sheet(self):
        points, quads = files.sheet()
        n = len(points)
        corner = points + [(0.03, 0.05, 0.05), (0.04, 0.05, 0.05)]
        moebius, strip = [], 40
        for i in range(strip):
            t = 2 * math.pi * i / strip
            moebius += [((1 + w * math.cos(t / 2)) * math.cos(t), (1 + w * math.cos(t / 2)) * math.sin(t),
                         w * math.sin(t / 2)) for w in (-0.3, 0.3)]
        around = [(2 * i, 2 * i + 1, *((2 * i + 3, 2 * i + 2) if i + 1 < strip else (0, 1))) for i in range(strip)]
        tube = [(0.01 * math.cos(k * math.pi / 6), 0.01 * math.sin(k * math.pi / 6), z) for z in (0.0, 0.1) for k in range(12)]
        box = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        cube = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        refused = {
            "an edge with three faces": (corner, quads + [(24, 25, n)]),
            "a closed tetrahedron": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]),
            "a closed cube": (box, cube), "a Moebius strip": (moebius, around),
            "no area": ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]),
            "all in a point": ([(1, 1, 1)] * len(points), quads)}
        self.read_surfaces("no sheet", refused, codes=(3,))
        self.read_surfaces("no sheet", {"a tube": (tube, [(k, (k + 1) % 12, 12 + (k + 1) % 12, 12 + k) for k in range(12)])})
        other = [(x + 0.2, y, z) for x, y, z in points[:14]]
        mixed = [q[::-1] if k % 3 else q for k, q in enumerate(quads)]
        repaired = {
            "two parts": (points + other, quads + [tuple(i + n for i in q) for q in quads[:6]], "separate pieces"),
            "parts that touch in a point": (points + [(0.0, 0.0, -0.02), (-0.02, 0.0, -0.02)], quads + [(0, n, n + 1)], ""),
            "mixed orientation": (points, mixed, "turned over"),
            "repeated faces": (points, quads + quads[:5], "repeated"),
            "faces without area": (points, quads + [(0, 0, 1), (1, 2, 2)], "without area"),
            "unused vertices": (points + [(9.0, 9.0, 9.0)], quads, "")}
        for case, (vertices, faces, note) in repaired.items():
            for key, data in files.meshes(vertices, faces).items():
                self.read("repaired", case, key, data, codes=(0,), says=note if key != "binary.stl" or case != "faces without area" else "")

    def test_odd_faces(self):
        points, quads = files.sheet()
        n = len(points)
        ring = [(0.03 * math.cos(a), 0.0, 0.05 + 0.05 * math.sin(a)) for a in (2 * math.pi * k / 300 for k in range(300))]
        star = [((0.05 if k % 2 else 0.01) * math.cos(math.pi * k / 10), 0.0, (0.05 if k % 2 else 0.01) * math.sin(math.pi * k / 10))
                for k in range(20)]
        needle = points + [(0.1, 0.0, 1e-9)]
        surfaces = {
            "one triangle": (points[:8], [(0, 7, 1)]), "one quadrilateral": (points, quads[:1]),
            "a polygon of 200": (ring[:200], [tuple(range(200))]), "a concave polygon": (star, [tuple(range(20))]),
            "a crossed quadrilateral": (points, quads[:-1] + [(quads[-1][0], quads[-1][2], quads[-1][1], quads[-1][3])]),
            "slivers": (needle, quads + [(6, 5, n)]),
            "a polygon with a vertex twice": (points, quads[:-1] + [quads[-1] + quads[-1][:1]]),
            "a very long thin sheet": files.sheet(2, 60, 1.0)}
        stretched = [(x * 1e-5, y, z) for x, y, z in points]
        surfaces["squeezed 1e5 times"] = stretched, quads
        self.read_surfaces("odd faces", surfaces)

    def test_outlines(self):
        ring = files.margin()
        oval = [(5 * math.cos(2 * math.pi * k / 12), 45 + 5 * math.sin(2 * math.pi * k / 12)) for k in range(12)]

        def moved(x, y, scale=1.0):
            return [(scale * a + x, scale * (b - 45) + 45 + y) for a, b in oval]

        shapes = {
            "a bow tie": ([(0, 0), (50, 50), (50, 0), (0, 50)],), "one triangle": ([(0, 0), (50, 0), (20, 90)],),
            "two points": ([(0, 0), (50, 0)],), "no area": ([(0, 0), (50, 0), (100, 0)],),
            "all one point": ([(5, 5)] * 9,), "repeated points": ([p for p in ring for _ in range(3)],),
            "there and back": (ring[:20] + ring[:20][::-1],), "a loop in the margin": (ring[:9] + [ring[5], ring[12]] + ring[13:],),
            "a hole": (ring, oval), "a hole that touches the margin": (ring, [ring[10], *moved(-3, 0)[2:8]]),
            "a hole across the margin": (ring, moved(30, 0)), "a hole outside": (ring, moved(200, 0)),
            "a hole in a hole": (ring, moved(0, 0, 2.0), moved(0, 0, 0.5)), "the hole is the margin": (ring, ring),
            "two holes that meet": (ring, moved(-3, 0), moved(3, 0)),
            "a needle": ([(0, 0), (1e-6, 50), (0, 100), (-1e-6, 50)],),
            "very many points": (files.margin(20000),)}
        cases = []
        for case, (outer, *holes) in shapes.items():
            cases += [(case, ".json", files.outline(outer, holes)), (case, ".svg", files.svg(outer, *holes)),
                      (case + " (nonzero)", ".svg", files.svg(outer, *holes, rule="nonzero"))]
        for case, data in {
                "no object": b"[1, 2]", "no outline": b"{}", "an outline of words": b'{"outline": "leaf"}',
                "points of three": b'{"outline": [[0,0,0],[1,0,0],[0,1,0]]}', "an unknown key": files.outline(ring, petoile=[0, 0]),
                "a petiole far away": files.outline(ring, petiole=[1e9, 1e9]), "a scale of 0": files.outline(ring, mm_per_unit=0),
                "a scale of -1": files.outline(ring, mm_per_unit=-1), "a scale of 1e300": files.outline(ring, mm_per_unit=1e300),
                "a scale of 1e-300": files.outline(ring, mm_per_unit=1e-300), "holes of numbers": files.outline(ring, [1, 2]),
                "no UTF-8": b'{"outl\xffine": []}', "two documents": GOOD[".json"] * 2, "a comma more": GOOD[".json"][:-2] + b",]}",
                "a byte order mark": b"\xef\xbb\xbf" + GOOD[".json"], "UTF-16": GOOD[".json"].decode().encode("utf-16")}.items():
            cases.append((case, ".json", data))
        for case, data in {
                "no shape": b'<svg xmlns="http://www.w3.org/2000/svg"/>', "HTML": b"<html><body>404</body></html>",
                "a use of itself": b'<svg><g id="a"><use href="#a"/></g></svg>',
                "uses that double": b"<svg>" + b"".join(b'<g id="a%d"><use href="#a%d"/><use href="#a%d"/></g>' % (k, k + 1, k + 1)
                                                         for k in range(30)) + b"</svg>",
                "not a path": b'<svg><path fill="red" d="M 0 0 L 1 Q"/></svg>',
                "an arc of radius 0": b'<svg><path d="M0 0 A0 0 0 0 1 10 10 L 0 50 Z"/></svg>',
                "UTF-16": GOOD[".svg"].decode().encode("utf-16")}.items():
            cases.append((case, ".svg", data))
        self.read_all("outlines", cases)


class Security(Cases):
    """Nothing is expanded, fetched or opened for a file that asks for it."""

    def test_xml(self):
        bomb = b'<!DOCTYPE svg [<!ENTITY a "' + b"1 2 " * 100 + b'">' + b"".join(
            b'<!ENTITY %c "%s">' % (98 + k, b"&%c;" % (97 + k) * 20) for k in range(9)) + b"]>"
        secret = self.dir / "secret.txt"
        secret.write_text("M0,0L50,0L50,90Z")
        external = b'<!DOCTYPE svg [<!ENTITY d SYSTEM "file://%s">]>' % bytes(secret)
        cases = [("entities that double", ".svg", bomb + b'<svg><path d="&j;"/></svg>'),
                 ("an entity from a file", ".svg", external + b'<svg><path d="&d;"/></svg>'),
                 ("an entity from a file", ".svg", external.replace(bytes(secret), b"/etc/passwd") + b"<svg><text>&d;</text></svg>")]
        self.read_all("entities and paths", cases, codes=(3,))
        image = GOOD[".svg"].replace(b"<path", b'<image href="file:///dev/zero" width="9" height="9"/><path')
        self.read_all("entities and paths", [("an image of /dev/zero", ".svg", image)], codes=(0,))

    def test_paths_in_files(self):
        document, buffer = files.gltf_parts(*files.sheet())
        (self.dir / "outside.bin").write_bytes(buffer)
        for uri in ("../outside.bin", "none.bin", str(self.dir / "outside.bin"), "file:///etc/passwd", "/dev/zero",
                    "http://127.0.0.1:9/x.bin", "data:application/octet-stream;base64,@@@@", "data:,", ""):
            text = json.dumps({**document, "buffers": [{"uri": uri, "byteLength": len(buffer)}]}).encode()
            self.read("entities and paths", f"the buffer '{uri[:20]}'", ".gltf", text, codes=(3,))
        for name in ("/etc/passwd", "../../x.mtl", "/dev/zero", "a\0b"):
            self.read("entities and paths", f"materials of '{name}'", ".obj", f"mtllib {name}\n".encode() + GOOD[".obj"], codes=(0,))


class Places(Cases):
    """What a path can be other than a plain file with a plain name."""

    def leaf(self, case, path, codes, says="", name=None, kind="paths", **options):
        result = wilt("leaf", path, "-o", self.dir / "out.obj", **options)
        self.judge(kind, case, result, codes, name if name is not None else os.path.basename(path), says)

    def test_no_plain_file(self):
        for ending in (".obj", ".svg", ".json", ".png", ".xyz"):
            path = str(self.dir / f"odd{ending}")
            self.leaf("missing", path, (3,))
            os.mkdir(path)
            self.leaf("a folder", path, (3,))
            os.rmdir(path)
            os.mkfifo(path)
            self.leaf("a pipe that nobody writes", path, (3,))
            os.unlink(path)
            os.symlink("/dev/zero", path)
            self.leaf("a device", path, (3,))
            os.unlink(path)
            os.symlink(path, path)
            self.leaf("a symbolic link to itself", path, (3,))
            os.unlink(path)
        self.leaf("a device", "/dev/zero", (3,))
        self.leaf("a device", "/dev/null", (3,))
        self.leaf("a name that is too long", "x" * 300 + ".obj", (3,), name="xxx")
        self.leaf("below a file", str(self.dir / "a.obj" / "b.obj"), (3,))
        self.leaf("nothing", "", (2, 3), name="")

    def test_unreadable(self):
        path = self.dir / "secret.obj"
        path.write_bytes(GOOD[".obj"])
        path.chmod(0)
        self.dir.chmod(stat.S_IRWXU | stat.S_IRWXG | stat.S_IRWXO)
        if os.geteuid() != 0:
            return self.leaf("unreadable", str(path), (3,), says="Permission denied")
        parent = pathlib.Path(WILT).resolve()
        if not all(p.stat().st_mode & stat.S_IXOTH for p in parent.parents):
            self.skipTest("another user cannot reach the program to try")
        self.leaf("unreadable", str(path), (3,), says="Permission denied", user="nobody", group="nogroup")

    def test_names(self):
        for name in (b"no utf-8 \xff\xfe.obj", b"two words.svg", b"new\nline.json", b"quote'.obj", b"-dash.obj",
                     b"\xe8\x91\x89.obj", b"tab\t\x1b[31m.obj", b"{}.obj", b"%s%n.obj"):
            path = os.path.join(os.fsencode(self.dir), name)
            with open(path, "wb") as file:
                file.write(GOOD[os.path.splitext(name.decode("latin-1"))[1]])
            given = b"./" + name
            result = wilt("leaf", given, "-o", "out.obj", "--json", cwd=self.dir)
            self.judge("names", repr(name), result, (0,), "", "")
            json.loads(result.stdout.decode())
            result = wilt("info", given, "--json", cwd=self.dir)
            self.judge("names", repr(name), result, (0,), "", "")
            json.loads(result.stdout.decode())
            for target in ("out.glb", "out.usda", "out.vtk.pvd"):
                result = wilt("leaf", given, "-o", target, cwd=self.dir)
                self.judge("names", repr(name), result, (0, 2), "", "")
            result = wilt("veins", given, "-o", "veins.json", cwd=self.dir)
            self.judge("names", repr(name), result, (0, 3), "", "")
            with open(path, "wb") as file:
                file.write(b"bad")
            result = wilt("leaf", given, "-o", "out.obj", cwd=self.dir)
            self.judge("names", repr(name), result, (3,), "", "")
            self.assertEqual(len(result.stderr.decode().strip().split("\n")), 1, result.stderr)
            self.assertNotIn(b"\x1b", result.stderr)
        (self.dir / "-dash.obj").write_bytes(GOOD[".obj"])
        self.judge("names", "-- -dash.obj", wilt("leaf", "-o", "out.obj", "--", "-dash.obj", cwd=self.dir), (0,), "", "")


class OtherReaders(Cases):
    """--config, --set, --veins, --mask, and the files that info and render take."""

    def file(self, name, data):
        path = self.dir / name
        path.write_bytes(data)
        return path

    def test_configuration(self):
        cases = {"empty": (b"", (0,)), "noise": (files.noise(500, 3), (2,)), "no UTF-8": (b"dt = 0.5 # \xff\xfe", (2,)),
                 "deep": (b"a = " + b"[" * 100000, (2,)), "deep keys": (b".".join([b"a"] * 100000) + b" = 1", (2,)),
                 "an unknown key": (b"dtt = 1", (2,)), "a table for a number": (b"[dt]\nx = 1", (2,)),
                 "twice": (b"dt = 0.5\ndt = 0.5", (2,)), "a very long line": (b"dt = " + b"1" * 1_000_000, (2,)),
                 "a date": (b"dt = 1979-05-27", (2,)), "an array": (b"dt = [1]", (2,)), "NUL": (b"dt = 0.5\0", (2,)),
                 "a list of words": (b"water.dry_region = ['a', 'b']", (2,)), "changes that are none": (b"change = [1, {}]", (2,)),
                 "a change of everything": (b"[[change]]\niteration = 1\nmodel = 'paper'", (2,)),
                 "deep keys in a list": (b"a = [0.1, {" + b".".join([b"1"] * 100000) + b" = 1}]", (2,))}
        for word in ("nan", "inf", "-inf", "1e400", "-1", "0", "true", '"x"', "1e-300", "1e300"):
            cases[f"dt = {word}"] = (f"dt = {word}".encode(), (2,))
        for case, (data, codes) in cases.items():
            path = self.file("run.toml", data)
            self.judge("configuration", case, wilt("simulate", "maple", "--config", path, "--print-config"), codes, "run.toml", "")
        for path, codes in ((self.dir, (3,)), (self.dir / "none.toml", (3,)), ("/dev/zero", (2, 3))):
            result = wilt("simulate", "maple", "--config", path, "--print-config")
            self.judge("configuration", str(path)[-9:], result, codes, str(path), "")

    def test_set(self):
        for word in ("dt", "=", "dt=", "=1", "dt=nan", "dt=inf", "dt=-1", "dt=1e999", "dt=1 2", "iterations=1.5",
                     "iterations=-1", "iterations=99999999999999999999", "species=", "species=oak", "model=x", "dt=\xff",
                     "water.humidity=2", "external.forces=1,2", "external.forces=1,2,x", "water.dry_region=0,0,1,0,1,99",
                     "water.dry_region=" + "1," * 5000 + "1", "change=1", "seed=-1", "x" * 300 + "=1", "dt=" + "1" * 300, "dt=\n", "a.b.c.d=1"):
            result = wilt("simulate", "maple", "--set", word, "--print-config")
            self.judge("--set", word[:20], result, (2,), "", "")

    def test_veins(self):
        leaf = ["maple", "--vertices", "300"]
        veins = self.dir / "good.json"
        self.assertEqual(wilt("veins", *leaf, "-o", veins).returncode, 0)
        good = json.loads(veins.read_text())

        def edited(change):
            copy = json.loads(veins.read_text())
            change(copy)
            return json.dumps(copy).encode()

        cases = {"empty": b"", "noise": files.noise(300, 1), "truncated": veins.read_bytes()[:500], "[]": b"[]", "{}": b"{}",
                 "deep": b"[" * 1_000_000, "deep veins": b'{"veins": ' + b"[" * 1_000_000 + b"]" * 1_000_000 + b"}",
                 "no veins": edited(lambda v: v["veins"].clear()), "veins of numbers": edited(lambda v: v.update(veins=[1])),
                 "another leaf": edited(lambda v: v["leaf"].update(vertices=7)),
                 "order 9": edited(lambda v: v["veins"][0].update(order=9)), "order 1e99": edited(lambda v: v["veins"][0].update(order=1e99)),
                 "order 2^40": edited(lambda v: v["veins"][0].update(order=2 ** 40)),
                 "far away": edited(lambda v: v["veins"][0].update(positions=[[1e9, 0, 0]], uv=[[5, 5]])),
                 "1e308": edited(lambda v: (v["veins"][0].pop("uv"), v["veins"][0].update(positions=[[1e308, -1e308, 1e308]] * 3))),
                 "no points": edited(lambda v: v["veins"][0].update(positions=[], uv=[])),
                 "one point": edited(lambda v: v["veins"][0].update(positions=good["veins"][0]["positions"][:1], uv=good["veins"][0]["uv"][:1]))}
        for case, data in cases.items():
            path = self.file("veins.json", data)
            result = wilt("veins", *leaf, "--veins", path, "-o", self.dir / "out.json")
            self.judge("veins.json", case, result, (0, 3), "veins.json", "")
        for path in (self.dir, self.dir / "none.json", "/dev/zero"):
            result = wilt("veins", *leaf, "--veins", path, "-o", self.dir / "out.json")
            self.judge("veins.json", str(path)[-9:], result, (3,), str(path), "")

    def test_mask(self):
        photo = self.file("photo.png", GOOD[".png"])
        black = files.png_of(160, 160, zlib.compress(bytes(160 * 481)))
        wide = files.png_of(320, 160, zlib.compress(bytes(160 * 961)))
        cases = {"empty": b"", "noise": files.noise(900, 2), "truncated": GOOD[".png"][:300], "all black": black, "another shape": wide,
                 "a mesh": GOOD[".obj"], "65535 x 65535": files.png_of(65535, 65535, b"")}
        for case, data in cases.items():
            mask = self.file("mask.png", data)
            self.judge("--mask", case, wilt("leaf", photo, "--mask", mask, "-o", self.dir / "o.obj"), (3,), "", "")
        for mask in (self.dir, self.dir / "none.png", "/dev/zero"):
            self.judge("--mask", str(mask)[-9:], wilt("leaf", photo, "--mask", mask, "-o", self.dir / "o.obj"), (3,), str(mask), "")

    def test_results(self):
        for name in ("m.glb", "m.usda", "m.pvd", "m.pc2", "m.mdd"):
            result = wilt("simulate", "maple", "--vertices", "200", "--iterations", "2", "--frames", "2", "-o", self.dir / name)
            self.assertEqual(result.returncode, 0, result.stderr)
        for good in sorted(self.dir.glob("m*.*")):
            data = good.read_bytes()
            spoiled = {"empty": b"", "noise": files.noise(2000, 1)}
            spoiled.update({f"cut at {share}": data[:int(share * len(data))] for share in (0.001, 0.1, 0.5, 0.999)})
            spoiled.update({f"changed, seed {s}": files.flipped(data, s, 0.0003) for s in range(6)})
            for case, bytes_ in spoiled.items():
                path = self.file("bad" + good.suffix, bytes_)
                result = wilt("info", path, "--json")
                self.judge("results: info", f"{good.suffix} {case}", result, (0, 3), path.name, "")
                if result.returncode == 0:
                    json.loads(result.stdout.decode())
                if good.suffix == ".glb":
                    result = wilt("render", path, "-o", self.dir / "o.png", "--size", "40x30", "--samples", "1")
                    self.judge("results: render", case, result, (0, 3), path.name, "")
        for path in (self.dir, self.dir / "none.glb", self.file("x.glb", GOOD[".glb"])):
            result = wilt("render", path, "-o", self.dir / "o.png")
            self.judge("results: render", path.name, result, (3,), path.name, "")
        for ending in (".pc2", ".mdd", ".usda", ".vtu", ".pvd", ".glb"):
            for case, make in (("a folder", os.mkdir), ("a device", lambda p: os.symlink("/dev/zero", p)), ("a pipe", os.mkfifo)):
                path = self.dir / (case[2:] + ending)
                make(path)
                self.judge("results: info", case + ending, wilt("info", path), (3,), path.name, "")


class WholeWay(Cases):
    """Files that are read although they are odd go on to a simulation."""

    def test_simulate(self):
        points, quads = files.sheet()
        cases = {"one triangle.obj": files.obj(points[:8], [(0, 7, 1)]), "tiny.json": files.outline(files.margin(size=1e-7)),
                 "huge.obj": files.obj([tuple(1e9 * c for c in p) for p in points], quads), "photo.png": GOOD[".png"],
                 "squeezed.obj": files.obj([(x * 1e-3, y, z) for x, y, z in points], quads)}
        for name, data in cases.items():
            path, report = self.dir / name, self.dir / "report.json"
            path.write_bytes(data)
            result = wilt("simulate", path, "--iterations", "3", "-o", self.dir / "out.glb", "--report", report)
            self.judge("simulated", name, result, (0, 3, 4), "", "")
            if result.returncode == 0:
                self.assertTrue(all_finite(json.loads(report.read_text())["frames"]), name)


def tearDownModule():
    print(f"\n{'kind':28} {'cases':>6} {'read':>6} {'refused':>8}")
    for kind, codes in sorted(TABLE.items()):
        print(f"{kind:28} {sum(codes.values()):6} {codes[0]:6} {sum(codes.values()) - codes[0]:8}")
    print(f"{'all':28} {sum(sum(c.values()) for c in TABLE.values()):6}")


if __name__ == "__main__":
    unittest.main()
