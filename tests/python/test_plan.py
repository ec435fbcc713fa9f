"""A plan's items made in Python are those of `wilt batch`.

Oracle: the program's folder, byte by byte.
"""
import filecmp
import json
import unittest

import wilt
from program import WithFolder, wilt as program

PLAN = """
count = 4
leaf = {choice = ["maple", "nowhere.obj"]}
seed = 3
[settings]
vertices = 300
iterations = 4
frames = 2
texture.size = 0
water.humidity = {uniform = [0.2, 0.8]}
[write]
files = ["leaf.obj", "veins.json"]
"""


def files_in(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


class Items(WithFolder):
    def test_are_the_programs_byte_by_byte(self):
        (self.dir / "plan.toml").write_text(PLAN)
        plan = wilt.Plan.read(self.dir / "plan.toml")
        mine, theirs = self.dir / "mine", self.dir / "theirs"
        self.assertEqual(len(plan), 4)
        self.assertFalse(plan.finish(mine))
        reports = [plan.run_item(item, mine) for item in range(4)]
        states = [report["state"] for report in reports]
        self.assertEqual(set(states), {"whole", "failed"})
        self.assertTrue(plan.finish(mine))
        wilt_batch = self.batch()
        self.assertIn("nowhere.obj", wilt_batch.stderr)
        self.assertEqual(files_in(mine), files_in(theirs))
        _, different, missing = filecmp.cmpfiles(mine, theirs, files_in(mine), shallow=False)
        self.assertEqual((different, missing), ([], []))
        for item, report in enumerate(reports):
            self.assertEqual(report["item"], item)
            self.assertTrue(plan.is_done(item, mine))
            self.assertEqual("nowhere.obj" in report.get("reason", ""), report["state"] == "failed")
        item = states.index("whole")
        label = json.loads((mine / f"items/{item:06}/item.json").read_text())
        self.assertEqual(plan.item(item)["chosen"], label["chosen"])
        self.assertEqual(plan.item(item)["config"], label["config"])

    def batch(self):
        done = program("batch", self.dir / "plan.toml", "-o", "theirs", cwd=self.dir)
        self.assertEqual(done.returncode, 4, done.stderr)
        return done

    def test_failures_are_recorded_and_tried_again_when_asked(self):
        plan = wilt.Plan(PLAN)
        item = next(item for item in range(4) if plan.item(item)["leaf"] == "maple")
        self.assertFalse(plan.is_done(item, self.dir / "out"))
        plan.record_failure(item, self.dir / "out", "its worker died")
        self.assertTrue(plan.is_done(item, self.dir / "out"))
        self.assertEqual(plan.run_item(item, self.dir / "out")["reason"], "its worker died")
        self.assertEqual(plan.run_item(item, self.dir / "out", retry=True)["state"], "whole")

    def test_mistakes_are_refused(self):
        with self.assertRaises(FileNotFoundError):
            wilt.Plan.read("nowhere.toml")
        with self.assertRaisesRegex(ValueError, "which leaves"):
            wilt.Plan("count = 3")
        with self.assertRaisesRegex(IndexError, "the plan has the items 0 to 3"):
            wilt.Plan(PLAN).run_item(4, self.dir)
        (self.dir / "file").write_text("")
        with self.assertRaises(OSError):
            wilt.Plan(PLAN).run_item(0, self.dir / "file")


if __name__ == "__main__":
    unittest.main()
