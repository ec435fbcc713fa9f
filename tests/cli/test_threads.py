"""The same bytes on any number of threads: every verb and every format.

Oracle: the bytes on one thread. Meshes of 20,000 vertices, so that loops over vertices, edges, faces and texels are split
several times. `wilt simulate`, `render` and `reproduce` are told the number of threads, also more than there are
processors; verbs without --threads run on one processor and on all.
"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

WILT = pathlib.Path(sys.argv.pop(1)).resolve()
THREADS = (1, 2, 3, 8)


def png_of_a_leaf():
    """A pointed green leaf on white, 500 x 300."""
    rows = bytearray()
    for y in range(300):
        rows.append(0)
        for x in range(500):
            inside = abs(x - 250) < 180 and abs(y - 150) < 100 * (1 - (abs(x - 250) / 180) ** 1.5)
            rows += bytes((60, 130 + x % 7, 40)) if inside else b"\xf0\xf0\xee"

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 500, 300, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes(rows))) + chunk(b"IEND", b""))


def bytes_of(path):
    """A file's bytes; of a report all but the time it took."""
    if path.name != "report.json":
        return path.read_bytes()
    report = json.loads(path.read_text())
    del report["timings_s"]
    return json.dumps(report).encode()


class SameBytes(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def run_alone(self, *arguments, processors=None):
        """Runs wilt in a folder of its own; its files, and its stdout as 'stdout'."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.dir))
        limit = (lambda: os.sched_setaffinity(0, processors)) if processors else None
        done = subprocess.run([WILT, *map(str, arguments)], cwd=folder, capture_output=True, preexec_fn=limit, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        files = {str(path.relative_to(folder)): bytes_of(path) for path in folder.rglob("*") if path.is_file()}
        return {**files, "stdout": done.stdout}

    def assert_same(self, expected, found, what):
        self.assertEqual(sorted(expected), sorted(found), what)
        for name in expected:
            self.assertTrue(expected[name] == found[name], f"{name} differs {what}")

    def check_threads(self, *arguments):
        runs = {n: self.run_alone(*arguments, "--threads", n) for n in THREADS}
        for n in THREADS[1:]:
            self.assert_same(runs[1], runs[n], f"on {n} threads: {arguments}")
        return runs[1]

    def check_processors(self, *arguments):
        processors = os.sched_getaffinity(0)
        one = self.run_alone(*arguments, processors={min(processors)})
        self.assert_same(one, self.run_alone(*arguments), f"on {len(processors)} processors: {arguments}")
        return one

    def test_a_run_of_the_default_model_in_every_format_and_its_pictures(self):
        names = ["m.glb", "m.usda", "m.pc2", "m.mdd", "m.pvd", "m.vtu", "m.vat.json", "m.obj", "m.ply", "s.#.obj", "s.#.ply"]
        files = self.check_threads("simulate", "maple", "--vertices", 20000, "--iterations", 2, "--frames", 2, "--set",
                                   "texture.size=512", "--report", "report.json", "--forces", "forces.csv",
                                   *[word for name in names for word in ("-o", name)])
        glb = self.dir / "m.glb"
        glb.write_bytes(files["m.glb"])
        small = ("--size", "200x150", "--samples", 4)
        self.check_threads("render", glb, "-o", "m.png", *small)
        self.check_threads("render", glb, "-o", "sheet.jpg", "--columns", 2, *small)
        self.check_processors("info", glb, "--json")

    def test_a_run_of_the_papers_model(self):
        self.check_threads("simulate", "grape", "--model", "paper", "--vertices", 20000, "--iterations", 20, "--frames", 3,
                           "--set", "texture.size=256", "-o", "m.glb", "--forces", "forces.csv")

    def test_figures_and_tables(self):
        self.check_threads("reproduce", "table1", "table2", "fig2", "-o", "out")

    def test_a_leaf_and_its_veins(self):
        files = self.check_processors("leaf", "ivy", "--vertices", 20000, "-o", "ivy.obj")
        mesh = self.dir / "ivy.obj"
        mesh.write_bytes(files["ivy.obj"])
        for name in ("veins.json", "veins.svg", "veins.obj"):
            self.check_processors("veins", mesh, "-o", name)

    def test_leaves_from_a_photo_and_a_scan(self):
        photo, scan = self.dir / "leaf.png", self.dir / "scan.xyz"
        photo.write_bytes(png_of_a_leaf())
        self.check_processors("simulate", photo, "--iterations", 2, "--frames", 2, "-o", "photo.glb")
        leaf = self.run_alone("leaf", "poplar", "--vertices", 8000, "-o", "leaf.obj")["leaf.obj"].decode()
        scan.write_text("".join(line[2:] + "\n" for line in leaf.splitlines() if line.startswith("v ")))
        self.check_processors("leaf", scan, "-o", "scan.glb")


if __name__ == "__main__":
    unittest.main()
