"""Tips come from geometry alone: a leaf written as OBJ or GLB and read back under another name has the same tips.

Oracle: the tips of the procedural leaf (maple 7, ivy 5, grape 5, poplar, tilia and willow 1), by position.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

WILT = sys.argv.pop(1)
TIPS = {"maple": 7, "poplar": 1, "tilia": 1, "ivy": 5, "willow": 1, "grape": 5}


def veins(*arguments):
    result = subprocess.run([WILT, "veins", *map(str, arguments), "--json"], capture_output=True, text=True, timeout=600)
    if result.returncode != 0:
        raise AssertionError(result.stderr)
    return json.loads(result.stdout)


class ReadBack(unittest.TestCase):
    def check(self, species, vertices, seed):
        with tempfile.TemporaryDirectory() as folder:
            original = veins(species, "--vertices", vertices, "--seed", seed)
            length = original["leaf"]["length"]
            self.assertEqual(len(original["tips"]), TIPS[species])
            for name in ("stranger.obj", "stranger.glb"):
                path = pathlib.Path(folder) / name
                subprocess.run([WILT, "leaf", species, "--vertices", str(vertices), "--seed", str(seed), "-q", "-o",
                                str(path)], check=True)
                back = veins(path)
                self.assertEqual(len(back["tips"]), TIPS[species], name)
                for a, b in zip(original["tips"], back["tips"]):
                    # float32 positions; a tip may move to the neighbour where two heights are equal to that precision
                    self.assertLess(math.dist(a["position"], b["position"]), 0.01 * length, name)


for species in TIPS:
    for vertices, seeds in ((800, (1, 2, 3, 4, 5)), (2000, (1, 4)), (5000, (1,))):
        for seed in seeds:
            def test(self, arguments=(species, vertices, seed)):
                self.check(*arguments)
            setattr(ReadBack, f"test_{species}_{vertices}_seed_{seed}", test)

if __name__ == "__main__":
    unittest.main()
