"""A run that is killed again and again, and gone on with, leaves the bytes of one that was not.

Usage: test_checkpoint.py WILT [--kills N] [--seed N]
"""

import argparse
import json
import os
import random
import re
import signal
import subprocess
import tempfile
import time
from collections import Counter
from pathlib import Path

RESULTS = ["leaf.glb", "leaf.mdd", "leaf.usda", "forces.csv", "frames/leaf.0000.ply", "frames/leaf.0004.ply"]
OLD = b"what stood there before"


def command(wilt, folder, *more):
    return [wilt, "simulate", "ivy", "--vertices", "500", "--iterations", "40", "--frames", "5", "--set", "texture.size=256",
            "-o", f"{folder}/leaf.glb", "-o", f"{folder}/leaf.mdd", "-o", f"{folder}/leaf.usda",
            "-o", f"{folder}/frames/leaf.####.ply", "--forces", f"{folder}/forces.csv",
            "--report", f"{folder}/report.json", *more]


def make_folder(folder):
    (folder / "frames").mkdir(parents=True)
    for name in RESULTS:
        (folder / name).write_bytes(OLD)


def report_of(folder):
    """All of it but the times."""
    report = json.loads((folder / "report.json").read_text())
    del report["timings_s"]
    return report


def run(words, **options):
    return subprocess.run(words, capture_output=True, text=True, **options)


class Killing:
    """Starts one run after the other, kills each at a random moment, and checks what it leaves."""

    def __init__(self, wilt, root, seed):
        self.wilt, self.root, self.random = wilt, root, random.Random(seed)
        reference = root / "reference"
        make_folder(reference)
        start = time.monotonic()
        done = run(command(wilt, reference))
        self.seconds = time.monotonic() - start
        assert done.returncode == 0, done.stderr
        self.expected = {name: (reference / name).read_bytes() for name in RESULTS}
        self.report = report_of(reference)
        self.outcomes, self.furthest, self.finished, self.orphans = Counter(), 0, 0, 0
        self.begin()

    def begin(self):
        self.folder = self.root / f"run{self.finished}"
        make_folder(self.folder)
        self.furthest = 0

    def start(self):
        return subprocess.Popen(
            command(self.wilt, self.folder, "--checkpoint", f"{self.folder}/run.checkpoint", "--resume",
                    "--checkpoint-every", "0"),
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def kill_once(self):
        process = self.start()
        if self.random.random() < 0.6:
            time.sleep(self.random.uniform(0.0, 1.2 * self.seconds))
        else:
            self.wait_for_results(process)
        process.send_signal(signal.SIGKILL)
        stderr = process.communicate()[1]
        if process.returncode == 0:
            self.finish()
            return False
        assert process.returncode == -signal.SIGKILL, f"exit {process.returncode}: {stderr}"
        self.check_progress(stderr)
        written = self.check_files()
        checkpoint = (self.folder / "run.checkpoint").exists()
        self.outcomes["while writing" if written else "while withering" if checkpoint else "before the first checkpoint"] += 1
        return True

    def wait_for_results(self, process):
        """Until the first result is there, and a moment longer: the others are being written."""
        first = self.folder / RESULTS[0]
        before = first.stat().st_ino
        while process.poll() is None and first.stat().st_ino == before:
            time.sleep(0.0005)
        time.sleep(self.random.uniform(0.0, 0.02))

    def check_progress(self, stderr):
        found = re.search(r"resumed after iteration (\d+) of 40", stderr)
        if found:
            assert int(found[1]) >= self.furthest, f"{found[0]}, but it had reached {self.furthest}"
            self.furthest = int(found[1])

    def check_files(self):
        """Every file is the old one or the whole new one; how many are new."""
        new = 0
        for name in RESULTS:
            content = (self.folder / name).read_bytes()
            assert content in (OLD, self.expected[name]), f"{name} is half written"
            new += content != OLD
        self.orphans += len(list(self.folder.rglob(".wilt-*")))
        for orphan in self.folder.rglob(".wilt-*"):
            orphan.unlink()
        return new

    def finish(self):
        """A run that came to its end before it was killed."""
        for name in RESULTS:
            assert (self.folder / name).read_bytes() == self.expected[name], f"{name} differs from the run that was not killed"
        assert report_of(self.folder) == self.report
        self.finished += 1
        self.begin()


def test_kills(wilt, root, kills, seed):
    killing = Killing(wilt, root, seed)
    count = 0
    while count < kills:
        count += killing.kill_once()
    process = killing.start()  # and once to the end
    stderr = process.communicate()[1]
    assert process.returncode == 0, stderr
    killing.finish()
    print(f"{count} kills: " + ", ".join(f"{n} {when}" for when, n in sorted(killing.outcomes.items())) +
          f"; {killing.finished} runs came to their end, all as the one that was never killed; "
          f"{killing.orphans} temporary files left behind")


def test_interrupt(wilt, root):
    """Ctrl-C leaves what was computed, and a checkpoint to go on from."""
    folder = root / "interrupted"
    make_folder(folder)
    words = command(wilt, folder, "--checkpoint", f"{folder}/run.checkpoint")
    process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    while not (folder / "run.checkpoint").exists():  # the first comes after the first iteration
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    stderr = process.communicate()[1]
    assert process.returncode == 130 and "--resume goes on" in stderr, stderr
    assert len(report_of(folder)["steps"]) < 40
    refused = run(words)
    assert refused.returncode == 2 and "add --resume" in refused.stderr, refused.stderr
    done = run(words + ["--resume"])
    assert done.returncode == 0 and "resumed after iteration" in done.stderr, done.stderr
    assert report_of(folder) == report_of(root / "reference")


def test_refusals(wilt, root):
    folder = root / "refused"
    make_folder(folder)
    checkpoint = folder / "run.checkpoint"
    words = command(wilt, folder, "--checkpoint", str(checkpoint), "--resume")
    assert run(words).returncode == 0
    whole = checkpoint.read_bytes()
    for change, code, text in [(["--set", "dt=0.05"], 3, "dt was 0.1 and is 0.05"), (["--seed", "2"], 3, "seed was 1 and is 2")]:
        refused = run(words + change)
        assert refused.returncode == code and text in refused.stderr and "run.checkpoint" in refused.stderr, refused.stderr
    for content, text in [(b"", "is not a checkpoint"), (whole[:1000], "cut off or changed"), (b"noise" * 99, "is not a checkpoint")]:
        checkpoint.write_bytes(content)
        refused = run(words)
        assert refused.returncode == 3 and text in refused.stderr, refused.stderr
        assert checkpoint.read_bytes() == content
    lonely = run(command(wilt, folder, "--resume"))
    assert lonely.returncode == 2 and "--checkpoint FILE" in lonely.stderr, lonely.stderr


def test_disk_that_is_full(wilt, root):
    """A checkpoint that cannot be written is said once; the results are written all the same."""
    folder = root / "full"
    make_folder(folder)
    locked = folder / "locked"
    locked.mkdir()
    words = command(wilt, folder, "--checkpoint", f"{locked}/run.checkpoint", "--checkpoint-every", "0")
    process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    while not (locked / "run.checkpoint").exists():
        time.sleep(0.005)
    locked.rename(folder / "gone")
    stderr = process.communicate()[1]
    assert process.returncode == 0, stderr
    assert stderr.count("no checkpoint:") == 1, stderr
    assert report_of(folder) == report_of(root / "reference")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("wilt")
    parser.add_argument("--kills", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    os.environ["NO_COLOR"] = "1"
    with tempfile.TemporaryDirectory() as name:
        root = Path(name)
        test_kills(options.wilt, root, options.kills, options.seed)
        test_interrupt(options.wilt, root)
        test_refusals(options.wilt, root)
        test_disk_that_is_full(options.wilt, root)
    print("checkpoints: all is well")


if __name__ == "__main__":
    main()
