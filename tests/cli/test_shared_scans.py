"""Scanned leaves, curled as they are, wither to the end. Skipped where the scans are absent.

Oracles: every step converged; a leaf of that many millimetres; a scan of touching leaflets is refused with exit code 3.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

WILT = sys.argv.pop(1)
SCANS = pathlib.Path(sys.argv.pop(1)) / "data" / "leaf_scans_3d"


class Scans(unittest.TestCase):
    def wither(self, name, millimetres):
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder) / "report.json"
            result = subprocess.run([WILT, "simulate", str(SCANS / name), "-o", f"{folder}/leaf.glb", "--report",
                                     str(report), "--vertices", "800"], capture_output=True, text=True, timeout=600)
            self.assertEqual(result.returncode, 0, result.stderr)
            data = json.loads(report.read_text())
            self.assertTrue(all(step["converged"] for step in data["steps"]))
            self.assertLess(data["metrics"]["max_strain"], 0.6)
            self.assertAlmostEqual(1000 * data["leaf"]["length"], millimetres, delta=0.08 * millimetres)

    def test_soybean(self):
        self.wither("soybean_11_20190508T043118_pot1_15.txt", 41)

    def test_sugar_beet_that_hangs(self):
        self.wither("sugarbeet_f00012_20170829T010129_pot1_1.txt", 61)

    def test_sugar_beet_with_its_stalk(self):
        self.wither("sugarbeet_f00012_20170830T140748_pot2_3.txt", 38)

    def test_leaflets_that_touch_are_refused(self):
        result = subprocess.run([WILT, "leaf", str(SCANS / "soybean_11_20190508T043118_pot1_1.txt"), "--json"],
                                capture_output=True, text=True, timeout=600)
        self.assertEqual(result.returncode, 3)
        self.assertIn("lies over itself", result.stderr)


if __name__ == "__main__":
    if not SCANS.is_dir():
        print(f"skipped: no scans in {SCANS}")
        sys.exit(77)
    unittest.main()
