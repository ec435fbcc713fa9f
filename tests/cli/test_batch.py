"""wilt batch: whole items whatever happens, the same bytes however they are shared out.

Usage: test_batch.py WILT [--kills N]
"""

import argparse
import hashlib
import json
import os
import random
import resource
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

WILT = ""
KILLS = 4

SMALL = """
seed = 3
count = 8
leaf = {choice = ["ivy", "willow"]}
[settings]
vertices = 300
iterations = 6
frames = 3
texture.size = 64
water.humidity = {uniform = [0.2, 0.9]}
[write]
files = ["leaf.glb", "forces.csv", "report.json"]
[pictures]
size = [48, 48]
samples = 2
maps = ["leaf", "depth"]
azimuth = {uniform = [-180, 180]}
[dataset]
layouts = ["coco", "webdataset"]
items_per_shard = 3
"""


def files_of(folder):
    """Name and bytes of every file."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in Path(folder).rglob("*") if p.is_file()}


class Batch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.root = Path(cls.temporary.name)
        cls.plan = cls.write("small.toml", SMALL)
        done = cls.run_batch(cls.plan, "serial", "--jobs", "1")
        assert done.returncode == 0, done.stderr
        cls.serial = files_of(cls.root / "serial")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def write(cls, name, text):
        (cls.root / name).write_text(text)
        return cls.root / name

    @classmethod
    def run_batch(cls, plan, folder, *more, **options):
        return subprocess.run([WILT, "batch", plan, "-o", cls.root / folder, *more], capture_output=True, text=True,
                              **options)

    def assert_serial(self, folder):
        """The files of a serial run, byte for byte. A kill may leave a hidden file that was about to get its name."""
        files = {name: content for name, content in files_of(self.root / folder).items()
                 if not Path(name).name.startswith(".wilt-")}
        self.assertEqual(sorted(files), sorted(self.serial))
        self.assertEqual([name for name in files if files[name] != self.serial[name]], [])

    def lines_of(self, folder):
        return [json.loads(line) for line in (self.root / folder / "manifest.jsonl").read_text().splitlines()]

    # Oracle: hashlib, the files themselves.
    def test_manifest_and_sums_are_those_of_the_files(self):
        lines = self.lines_of("serial")
        self.assertEqual([line["item"] for line in lines], list(range(8)))
        for line in lines:
            for name, facts in line["files"].items():
                content = self.serial[f"items/{line['item']:06}/{name}"]
                self.assertEqual(facts["bytes"], len(content))
                self.assertEqual(facts["sha256"], hashlib.sha256(content).hexdigest())
            self.assertEqual(set(line["files"]), {"leaf.glb", "forces.csv", "report.json", "picture.png",
                                                  "picture.leaf.png", "picture.depth.png"})
        check = subprocess.run(["sha256sum", "-c", "--quiet", "SHA256SUMS"], cwd=self.root / "serial")
        self.assertEqual(check.returncode, 0)

    # Oracle: `wilt simulate` with the item's own settings gives the item's own bytes.
    def test_an_item_is_what_simulate_makes_of_its_settings(self):
        labels = json.loads(self.serial["items/000002/item.json"])
        lone = self.root / "lone.glb"

        def text(value):
            if isinstance(value, list):
                return ",".join(map(str, value))
            return str(value).lower() if isinstance(value, bool) else value

        words = [word for key, value in labels["config"].items() if key != "species"
                 for word in ("--set", f"{key}={text(value)}")]
        subprocess.run([WILT, "simulate", labels["chosen"]["leaf"], "-q", "-o", lone, *words], check=True)
        self.assertEqual(lone.read_bytes(), self.serial["items/000002/leaf.glb"])

    def test_shards_and_jobs_give_the_bytes_of_a_serial_run(self):
        for index in (2, 7, 1, 3, 6, 5, 4):  # in any order
            done = self.run_batch(self.plan, "shards", "--shard", f"{index}/7", "--jobs", "2")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_serial("shards")

    def test_two_processes_in_one_folder_give_the_bytes_of_one(self):
        words = [WILT, "batch", self.plan, "-o", self.root / "both", "-q"]
        both = [subprocess.Popen(words), subprocess.Popen(words)]
        self.assertEqual([process.wait() for process in both], [0, 0])
        self.assert_serial("both")

    def test_a_second_run_makes_nothing(self):
        before = {path: path.stat().st_mtime_ns for path in (self.root / "serial").rglob("*")}
        done = self.run_batch(self.plan, "serial", "--json")
        self.assertEqual(json.loads(done.stdout)["made"], 0)
        self.assertEqual({path: path.stat().st_mtime_ns for path in (self.root / "serial").rglob("*")}, before)

    # Every item's folder that is there at any moment is whole, and the run that goes on ends with the same bytes.
    def test_killed_at_random_moments_it_leaves_whole_items_and_goes_on(self):
        chance = random.Random(5)
        for _ in range(KILLS):
            process = subprocess.Popen([WILT, "batch", self.plan, "-o", self.root / "killed", "-q"],
                                       start_new_session=True)
            time.sleep(chance.uniform(0.02, 0.5))
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            for folder in (self.root / "killed" / "items").glob("[0-9]*"):
                for path in folder.iterdir():
                    name = f"items/{folder.name}/{path.name}"
                    self.assertTrue(path.read_bytes() == self.serial[name], name)
                self.assertEqual(len(list(folder.iterdir())), 7)
        done = self.run_batch(self.plan, "killed")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_serial("killed")

    def test_a_worker_that_is_killed_loses_nothing(self):
        process = subprocess.Popen([WILT, "batch", self.plan, "-o", self.root / "orphan", "-q", "--jobs", "2"])
        deadline = time.monotonic() + 5
        children = []
        while not children and time.monotonic() < deadline:
            children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        time.sleep(0.05)
        for child in children:
            os.kill(int(child), signal.SIGKILL)
        self.assertEqual(process.wait(), 0)
        self.assert_serial("orphan")

    def test_ctrl_c_keeps_whole_items_and_says_so(self):
        plan = self.write("long.toml", SMALL.replace("count = 8", "count = 5000"))
        process = subprocess.Popen([WILT, "batch", plan, "-o", self.root / "stopped"], stderr=subprocess.PIPE, text=True)
        while not list(self.root.glob("stopped/items/[0-9]*")):
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        message = process.communicate(timeout=30)[1]
        self.assertEqual(process.returncode, 130)
        self.assertIn("the same command goes on", message)
        self.assertEqual(list((self.root / "stopped/items").glob(".*")), [])

    def test_a_failing_item_is_recorded_and_the_rest_is_made(self):
        plan = self.write("failing.toml", """
            leaf = {grid = ["ivy", "empty.svg", "missing.png"]}
            [settings]
            vertices = 300
            iterations = 3
            texture.size = 64
            [write]
            files = ["leaf.ply"]""")
        (self.root / "empty.svg").write_text("")
        done = self.run_batch(plan, "failing")
        self.assertEqual(done.returncode, 4)
        self.assertIn("2 items could not be made", done.stderr)
        lines = self.lines_of("failing")
        self.assertIn("files", lines[0])
        self.assertIn("empty.svg", lines[1]["reason"])
        self.assertIn("there is no file", lines[2]["reason"])
        (self.root / "elsewhere").mkdir()  # the reasons name no folders
        other = subprocess.run([WILT, "batch", "../failing.toml", "-o", self.root / "failing2"], capture_output=True,
                               cwd=self.root / "elsewhere")
        self.assertEqual(other.returncode, 4)
        self.assertEqual(files_of(self.root / "failing2"), files_of(self.root / "failing"))
        again = self.run_batch(plan, "failing", "--json")
        self.assertEqual((again.returncode, json.loads(again.stdout)["made"]), (4, 0))
        (self.root / "missing.png").write_text("")  # other contents: another item
        self.assertIn("choose another folder", self.run_batch(plan, "failing").stderr)
        (self.root / "missing.png").unlink()
        before = files_of(self.root / "failing")
        self.run_batch(plan, "failing", "--retry", "--dry-run")
        self.assertEqual(files_of(self.root / "failing"), before)
        retried = self.run_batch(plan, "failing", "--retry")
        self.assertEqual(retried.returncode, 4)

    def test_a_folder_of_another_plan_is_left_alone(self):
        other = self.write("other.toml", SMALL.replace("seed = 3", "seed = 4"))
        done = self.run_batch(other, "serial")
        self.assertEqual(done.returncode, 2)
        self.assertIn("is of another plan", done.stderr)
        self.assert_serial("serial")

    def test_a_full_disk_ends_it_and_nothing_half_is_whole(self):
        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))

        done = self.run_batch(self.plan, "full", preexec_fn=small_files)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertEqual(list((self.root / "full/items").iterdir()), [])
        self.assertEqual(self.run_batch(self.plan, "full").returncode, 0)
        self.assert_serial("full")

    def test_dry_run_says_how_much_and_writes_nothing(self):
        done = self.run_batch(self.plan, "never", "--dry-run", "--json")
        facts = json.loads(done.stdout)
        self.assertEqual((facts["items"], facts["to_make"], facts["there"]), (8, 8, 0))
        size = sum(len(content) for name, content in self.serial.items() if name.startswith(("items", "webdataset")))
        self.assertGreater(facts["bytes"], size / 2)
        self.assertLess(facts["bytes"], size * 2)
        self.assertFalse((self.root / "never").exists())

    def test_wrong_plans_are_refused(self):
        for words, message in [(["absent.toml"], "absent.toml"), ([self.plan, "--shard", "4/3"], "3/7")]:
            done = subprocess.run([WILT, "batch", *words, "-o", self.root / "refused"], capture_output=True, text=True)
            self.assertIn(message, done.stderr)
            self.assertIn(done.returncode, (2, 3))
        self.assertFalse((self.root / "refused").exists())


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("wilt")
    parser.add_argument("--kills", type=int, default=KILLS)
    arguments, rest = parser.parse_known_args()
    WILT, KILLS = os.path.abspath(arguments.wilt), arguments.kills
    unittest.main(argv=[__file__, *rest])
