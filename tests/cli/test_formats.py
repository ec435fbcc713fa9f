"""What `wilt simulate -o` writes, file by file, against the GLB of the same run.

Oracle: the readers of tests/output, which share no code with wilt; the GLB's frames (tests/output/check_glb.py reads
them) within float32. Prints a line per format with the largest error of a position.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "output"))
import readers  # noqa: E402
from check_formats import EPS, grid, vtkXMLUnstructuredGridReader  # noqa: E402
from check_glb import Glb  # noqa: E402

WILT = sys.argv.pop(1)
FRAMES = 4


def wilt(*arguments):
    return subprocess.run([WILT, *map(str, arguments)], capture_output=True, text=True, timeout=600)


class EveryFormatOfOneRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.dir = pathlib.Path(cls.folder.name)
        names = ["m.glb", "m.usda", "m.pc2", "m.mdd", "m.pvd", "m.vtu", "m.obj", "m.ply", "s.###.obj", "s.###.ply"]
        outputs = [word for name in names for word in ("-o", cls.dir / name)]
        cls.run_ = wilt("simulate", "grape", "--vertices", 500, "--iterations", 40, "--frames", FRAMES, *outputs)
        if cls.run_.returncode != 0:
            raise AssertionError(cls.run_.stderr)
        glb = Glb(cls.dir / "m.glb")
        blade = glb.json["meshes"][0]["primitives"][0]
        # A species has no seams: the skin's vertices are the mesh's.
        cls.frames = np.stack(glb.frames(blade, "POSITION"))
        cls.extras = glb.json["asset"]["extras"]["wilt"]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def compare(self, name, found, expected):
        error = np.abs(np.asarray(found) - expected).max()
        print(f"grape: {name:10} largest error of a position against the GLB {error:.1e} m of {self.frames.max():.2g} m")
        self.assertLessEqual(error, 2 * EPS * np.abs(self.frames).max())  # two roundings in a GLB

    def test_point_caches(self):
        start, rate, samples = readers.pc2(self.dir / "m.pc2")
        iterations = np.array(self.extras["frames"], float)
        even = np.interp(np.linspace(0, iterations[-1], FRAMES), iterations, np.arange(FRAMES))
        stacked = self.frames.reshape(FRAMES, -1)
        expected = np.stack([np.interp(even, np.arange(FRAMES), column) for column in stacked.T], axis=1)
        self.compare("PC2", samples, expected.reshape(samples.shape))
        self.assertAlmostEqual(rate, 24 * 4 / (FRAMES - 1))
        times, frames = readers.mdd(self.dir / "m.mdd")
        self.compare("MDD", frames, self.frames)
        np.testing.assert_allclose(times, 4 * iterations / iterations[-1], rtol=EPS)
        self.assertTrue((self.dir / "m.stalk.pc2").exists() and (self.dir / "m.stalk.mdd").exists())

    def test_obj_and_ply(self):
        size = self.frames.shape[1]
        last = readers.obj(self.dir / "m.obj")
        self.compare("OBJ", last["v"][:size], self.frames[-1])
        self.assertTrue((self.dir / readers.mtl(self.dir / "m.mtl")["blade"]["map_Kd"][0]).exists())
        self.compare("OBJ frames", [readers.obj(self.dir / f"s.{k:03}.obj")["v"][:size] for k in range(FRAMES)], self.frames)
        vertices = [readers.ply(self.dir / f"s.{k:03}.ply")[0][:size] for k in range(FRAMES)]
        self.compare("PLY frames", [readers.columns(v, "x", "y", "z") for v in vertices], self.frames)
        self.assertEqual((self.dir / "m.ply").read_bytes(), (self.dir / f"s.{FRAMES - 1:03}.ply").read_bytes())
        means = [float(v["dryness"].mean()) for v in vertices]
        np.testing.assert_allclose(means, self.extras["dryness"], atol=1e-6)
        self.assertEqual(sorted(p.name for p in self.dir.glob("s.*.texture.jpg")), [f"s.{k:03}.texture.jpg" for k in range(FRAMES)])

    def test_vtk(self):
        if not vtkXMLUnstructuredGridReader:
            self.skipTest("VTK's Python is not installed (python3-vtk9)")
        blades = [(time, path) for time, part, path in readers.pvd(self.dir / "m.pvd") if part == 0]
        self.compare("VTU + PVD", [grid(path)[0] for _, path in blades], self.frames)
        hours = self.extras["config"]["clip.hours"] / 100 * np.array(self.extras["frames"])
        np.testing.assert_allclose([time for time, _ in blades], hours)
        self.compare("VTU", grid(self.dir / "m.vtu")[0], self.frames[-1])

    def test_usd(self):
        text = (self.dir / "m.usda").read_text()
        samples = text[text.index("point3f[] points.timeSamples") :].split("}")[0].splitlines()[1 : FRAMES + 1]
        numbers = [re.findall(r"[-\d.e]+", line.split(":")[1]) for line in samples]
        self.compare("USD", np.array(numbers, float).reshape(self.frames.shape), self.frames)
        self.assertIn("@./m.texture.jpg@", text)

    def test_the_configuration_is_in_every_file_that_has_room(self):
        config = json.dumps(self.extras["config"], separators=(",", ":"))
        for name in ("m.obj", "m.ply", "m.vtu", "m.pvd"):
            self.assertIn(config, (self.dir / name).read_bytes().decode("latin1").replace("\0", ""), name)
        self.assertIn(config.replace('"', '\\"'), (self.dir / "m.usda").read_text())

    def test_info_tells_what_is_in_each(self):
        size = self.frames.shape[1]
        for name, expected in {"m.pc2": {"vertices": size, "frames": FRAMES, "scene_frames": 96.0},
                               "m.mdd": {"vertices": size, "frames": FRAMES, "seconds": 4.0},
                               "m.usda": {"leaf": "grape", "time_codes": 96, "frame_rate": 24},
                               "m.vtu": {"vertices": size, "hours": 19.2},
                               "m.pvd": {"frames": FRAMES, "hours": 19.2}}.items():
            found = json.loads(wilt("info", self.dir / name, "--json").stdout)
            self.assertEqual({**found, **expected}, found, name)
        cut = self.dir / "cut.pc2"
        cut.write_bytes((self.dir / "m.pc2").read_bytes()[:-4])
        result = wilt("info", cut)
        self.assertEqual(result.returncode, 3)
        self.assertIn("cut short", result.stderr)

    def test_maps_are_shared_between_formats(self):
        for name in ("m.texture.jpg", "m.normal.jpg", "s.normal.jpg"):
            self.assertEqual((self.dir / name).read_bytes()[:2], b"\xff\xd8", name)


class WrongNames(unittest.TestCase):
    def refuse(self, *outputs, says):
        with tempfile.TemporaryDirectory() as folder:
            words = [word for name in outputs for word in ("-o", pathlib.Path(folder) / name)]
            result = wilt("simulate", "grape", *words)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(says, result.stderr)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])

    def test_two_results_that_write_one_file_are_refused_before_the_work(self):
        self.refuse("m.obj", "m.####.obj", says="would both write")
        self.refuse("m.pvd", "m_0003.vtu", says="m_0003.vtu")
        self.refuse("m.pc2", "m.stalk.pc2", says="m.stalk.pc2")
        self.refuse("m.usda", "m.texture.jpg", says="m.texture.jpg")
        self.refuse("m.#.ply", "m.5.ply", says="m.5.ply")

    def test_other_names_are_refused_with_the_table(self):
        self.refuse("m.usdc", says=".usda (all frames as time samples")
        self.refuse("m.#.#.obj", says="one row of")


if __name__ == "__main__":
    unittest.main()
