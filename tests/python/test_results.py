"""Results in Python are written as the program writes them.

Oracles: the program's files, byte by byte; a CSV and a JSON reader.
"""
import csv
import filecmp
import json
import unittest

import cv2
import numpy as np

import wilt
from program import WithFolder

OPTIONS = ["--vertices", 300, "--iterations", 8, "--frames", 3, "--set", "texture.size=128"]


def simulation():
    return wilt.Simulation(wilt.Leaf.from_species("ivy", vertices=300), iterations=8, frames=3, texture__size=128)


class Files(WithFolder):
    def test_are_the_programs_byte_by_byte(self):
        (self.dir / "mine").mkdir()
        (self.dir / "theirs").mkdir()
        names = ["a.glb", "a.usda", "a.mdd", "a.pvd", "a.vat.json", "frames.##.ply"]
        simulation().run().save(*(self.dir / "mine" / name for name in names), max_morphs=2, lods=1, vat="png")
        outputs = [word for name in names for word in ("-o", f"theirs/{name}")]
        self.program("simulate", "ivy", *OPTIONS, *outputs, "--max-morphs", 2, "--lods", 1, "--vat", "png")
        mine = sorted(path.name for path in (self.dir / "mine").iterdir())
        self.assertEqual(mine, sorted(path.name for path in (self.dir / "theirs").iterdir()))
        self.assertGreater(len(mine), len(names))
        same, different, missing = filecmp.cmpfiles(self.dir / "mine", self.dir / "theirs", mine, shallow=False)
        self.assertEqual((sorted(same), different, missing), (mine, [], []))

    def test_a_result_taken_early_is_a_whole_one(self):
        sim = simulation()
        sim.step()
        sim.result.save(self.dir / "early.glb")
        self.program("info", "early.glb")
        self.assertEqual([frame.iteration for frame in sim.result.frames], [0, 1])

    def test_nothing_is_written_where_something_cannot_be(self):
        result = simulation().result
        for names, kind, words in ((["a.glb", "b.xyz"], ValueError, "results are .glb"),
                                   (["a.glb", "no/b.glb"], OSError, "cannot write")):
            with self.assertRaisesRegex(kind, words):
                result.save(*(self.dir / name for name in names))
            self.assertEqual(list(self.dir.iterdir()), [])
        for options, words in (({"max_morphs": 1}, "max_morphs 1"), ({"lods": 9}, "lods 9"), ({"vat": "pgn"}, "'png'")):
            with self.assertRaisesRegex(ValueError, words):
                result.save(self.dir / "a.glb", **options)

    def test_a_picture_is_the_programs(self):
        result = simulation().run()
        result.save(self.dir / "leaf.glb")
        self.program("render", "leaf.glb", "-o", "leaf.png", "--size", "96x64", "--frame", 1)
        pixels = result.picture(1, 96, 64)
        self.assertEqual((pixels.shape, pixels.dtype), ((64, 96, 3), np.uint8))
        np.testing.assert_array_equal(pixels, cv2.imread(str(self.dir / "leaf.png"))[:, :, ::-1])
        np.testing.assert_array_equal(result.picture(0, 64, 48), result.picture(-3, 64, 48))
        with self.assertRaisesRegex(ValueError, "frame 3 must be -3 to 2"):
            result.picture(3)


class Tables(WithFolder):
    def test_forces_are_the_programs(self):
        forces = simulation().run().forces
        self.program("simulate", "ivy", *OPTIONS, "--forces", "forces.csv")
        with open(self.dir / "forces.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(set(forces), set(rows[0]))
        self.assertEqual(forces["region"].tolist(), [row["region"] for row in rows])
        for name in set(forces) - {"region"}:
            np.testing.assert_allclose(forces[name], [float(row[name]) for row in rows], rtol=1e-8)


class Reproduction(WithFolder):
    def test_of_a_table_is_the_programs(self):
        claims = wilt.reproduce(["table1"], self.dir / "mine", vertices=300, size=(64, 48), samples=1)
        done = self.program("reproduce", "table1", "-o", "theirs", "--vertices", 300, "--size", "64x48", "--samples", 1, "--json")
        self.assertEqual(claims, json.loads(done.stdout))
        self.assertTrue(claims)
        for name in ("claims.csv", "index.html"):
            self.assertEqual((self.dir / "mine" / name).read_bytes(), (self.dir / "theirs" / name).read_bytes())
        with self.assertRaisesRegex(ValueError, "unknown figure 'fig77'"):
            wilt.reproduce(["fig77"], self.dir / "other")


if __name__ == "__main__":
    unittest.main()
