"""Drawings that nobody here made become withered leaves. Skipped where the drawings are absent.

Oracles: the number of lobes that a person counts on the drawing of the ivy; every step converged.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

WILT = sys.argv.pop(1)
OUTLINES = pathlib.Path(sys.argv.pop(1)) / "data" / "outlines"


class Drawings(unittest.TestCase):
    def wither(self, name):
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder) / "report.json"
            result = subprocess.run([WILT, "simulate", str(OUTLINES / name), "-o", f"{folder}/leaf.glb", "--report",
                                     str(report)], capture_output=True, text=True, timeout=600)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("a stalk was cut off", result.stderr)
            data = json.loads(report.read_text())
            self.assertTrue(all(step["converged"] for step in data["steps"]))
            self.assertLess(data["metrics"]["max_strain"], 0.6)
            self.assertGreater(data["metrics"]["curl"], 30)
            return data

    def test_ivy_has_five_tips(self):
        self.assertEqual(self.wither("leaf_01.svg")["leaf"]["tips"], 5)

    def test_maple(self):
        self.wither("fall_coloured_leaf_geral_01.svg")

    def test_oak(self):
        self.wither("fall_coloured_leaf_geral_02.svg")


if __name__ == "__main__":
    if not OUTLINES.is_dir():
        print(f"skipped: no drawings in {OUTLINES}")
        sys.exit(77)
    unittest.main()
