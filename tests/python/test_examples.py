"""The example scripts run and find what they should.

Oracles: the loss of water by Dalton's law, which the model takes; the files that a script says it wrote.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import unittest

from program import WithFolder

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"


class Examples(WithFolder):
    def run_example(self, name, *arguments):
        done = subprocess.run([sys.executable, "-B", EXAMPLES / name, *map(str, arguments)], capture_output=True, text=True,
                              timeout=600, cwd=self.dir)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_the_plant_scientists_leaf_loses_water_as_the_air_is_dry(self):
        self.run_example("plant_scientist.py", "willow", self.dir)
        with open(self.dir / "willow.csv", newline="") as file:
            last = {float(row["humidity"]): row for row in csv.DictReader(file)}
        self.assertEqual(len(last), 9)
        lost = {humidity: 1 - float(row["water"]) for humidity, row in last.items()}
        for humidity in (0.3, 0.5, 0.8):  # in proportion to the deficit of vapour, 1 - humidity
            self.assertAlmostEqual(lost[humidity] / lost[0.9], (1 - humidity) / 0.1, delta=0.01)
        self.assertGreater(float(last[0.5]["curl_degrees"]), float(last[0.9]["curl_degrees"]))

    def test_the_data_makers_leaves_are_labelled_and_not_made_twice(self):
        self.assertIn("2 of 2 leaves are to be made", self.run_example("data_maker.py", 2, self.dir / "leaves"))
        coco = json.loads((self.dir / "leaves/coco.json").read_text())
        self.assertEqual(len(coco["images"]), 2)
        for image in coco["images"]:
            self.assertTrue((self.dir / "leaves" / image["file_name"]).exists(), image)
        self.assertIn("0 of 2 leaves are to be made", self.run_example("data_maker.py", 2, self.dir / "leaves"))

    def test_the_animators_lines_for_blender_are_python(self):
        """Blender is large and not there; the whole script takes a while: its leaf is made smaller, no picture rendered."""
        script = (EXAMPLES / "animator.py").read_text().replace("vertices=4000", "vertices=300")
        script = script.replace(', folder / f"{leaf.name}.png"', "")
        small = self.dir / "examples" / "python" / "animator.py"
        small.parent.mkdir(parents=True)
        small.write_text(script)
        done = subprocess.run([sys.executable, "-B", small, "willow", self.dir], capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.program("info", "willow.glb")
        lines = done.stdout.split("console:\n")[1]
        compile("\n".join(line.strip() for line in lines.splitlines()), "console", "exec")
        self.assertIn(str(self.dir / "willow.glb"), lines)
        self.assertTrue((EXAMPLES.parents[1] / "integrations/blender/wilt_import.py").exists())


if __name__ == "__main__":
    os.environ.pop("MALLOC_PERTURB_", None)  # as a user runs them
    unittest.main()
