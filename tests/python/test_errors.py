"""Errors have the program's messages and Python's kinds.

Oracle: what the program writes to stderr for the same mistake.
"""
import unittest

import wilt
from program import WithFolder, wilt as program

LEAF = wilt.Leaf.from_species("maple", vertices=300)


class Messages(WithFolder):
    def check(self, kind, act, *arguments):
        with self.assertRaises(kind) as raised:
            act()
        self.assertIs(type(raised.exception), kind)
        said = program(*arguments, cwd=self.dir)
        self.assertNotEqual(said.returncode, 0)
        self.assertEqual(f"error: {raised.exception}", said.stderr.strip().splitlines()[-1])

    def setting(self, assignment, **settings):
        self.check(ValueError, lambda: wilt.Simulation(LEAF, **settings),
                   "simulate", "maple", "-o", "x.glb", "--set", assignment)

    def test_of_settings(self):
        self.setting("water.humidty=0.3", water__humidty=0.3)
        self.setting("water.humidity=3", water__humidity=3)
        self.setting("dt=fast", dt="fast")
        self.setting("pin=rign", pin="rign")
        self.setting("veins.secondary=7", veins__secondary=7)
        self.setting("model=papr", model="papr")
        (self.dir / "bad.toml").write_text("[water]\nhumidity = 'wet'\n")
        self.check(ValueError, lambda: wilt.Simulation(LEAF, config=self.dir / "bad.toml"),
                   "simulate", "maple", "-o", "x.glb", "--config", self.dir / "bad.toml")

    def test_of_files_that_are_not_there(self):
        self.check(FileNotFoundError, lambda: wilt.Leaf.from_file("nowhere/leaf.obj"), "leaf", "nowhere/leaf.obj", "-o", "x.glb")
        self.check(FileNotFoundError, lambda: wilt.Simulation(LEAF, config="nowhere.toml"),
                   "simulate", "maple", "-o", "x.glb", "--config", "nowhere.toml")
        self.check(FileNotFoundError, lambda: LEAF.veins(file="nowhere.json"),
                   "veins", "maple", "-o", "x.json", "--veins", "nowhere.json")

    def test_of_files_that_are_no_leaf(self):
        (self.dir / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 2 9\n")
        (self.dir / "bad.json").write_text('{"outline": [[0,0],[1,0]]}')
        (self.dir / "bad.png").write_text("no picture")
        for name in ("bad.obj", "bad.json", "bad.png"):
            self.check(ValueError, lambda: wilt.Leaf.from_file(self.dir / name), "leaf", self.dir / name, "-o", "x.glb")

    def test_of_files_that_cannot_be_written(self):
        result = wilt.Simulation(LEAF, iterations=0).run()
        self.check(OSError, lambda: result.save(self.dir / "no/x.glb"), "simulate", "maple", "-o", self.dir / "no/x.glb")
        self.check(ValueError, lambda: result.save("x.foo"), "simulate", "maple", "-o", "x.foo")

    def test_of_a_species(self):
        with self.assertRaisesRegex(ValueError, r"there is no species 'mapel' \(did you mean 'maple'\?\)"):
            wilt.Leaf.from_species("mapel")
        with self.assertRaisesRegex(ValueError, "200"):
            wilt.Leaf.from_species("maple", vertices=7)

    def test_none_and_what_was_not_made_are_refused(self):
        for act in (lambda: wilt.Simulation(None), lambda: wilt.Leaf(), lambda: wilt.Leaf.positions.fget(None),
                    lambda: wilt.Frame.dryness.fget(None), lambda: wilt.State.water.fget(None), lambda: wilt.Venation.s.fget(None),
                    lambda: wilt.Venation.veins.fget(None), lambda: wilt.Leaf.veins(None), lambda: wilt.Simulation.run(None),
                    lambda: wilt.Simulation("maple"), lambda: wilt.Simulation(LEAF, config=7),
                    lambda: wilt.Simulation(LEAF, iterations=0).result.save(3)):
            self.assertRaises(TypeError, act)

    def test_a_leafs_seed_and_size_are_its_own(self):
        with self.assertRaisesRegex(ValueError, "seed is 4, but the leaf was made with 1; give seed=4 where it is made"):
            wilt.Simulation(LEAF, seed=4)
        with self.assertRaisesRegex(ValueError, "vertices is 500, but the leaf was made with 300"):
            wilt.Simulation(LEAF, vertices=500)


if __name__ == "__main__":
    unittest.main()
