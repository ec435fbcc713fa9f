"""Ctrl-C, SIGTERM and SIGHUP at every stage of every verb: exit code 130, what was computed is kept, no half file.

Oracles: the contract of the exit code; the length that a GLB states; the bytes of old files; listings. Pipes that wait make
the moment of a signal certain; other moments are random (seed 1). How long the slowest took to end is printed, not asserted.
Seen to fail: a handler that only asks, as in withering, hangs in the tests whose pipes nobody fills.
"""
import fcntl
import json
import os
import pathlib
import random
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import voice

WILT = sys.argv.pop(1)
OLD = b"the old file"
LEAF = ["ivy", "--vertices", "200"]
SHORT = ["simulate", *LEAF, "--iterations", "2", "--frames", "2", "--set", "texture.size=64"]


def is_whole(path):
    data = path.read_bytes()
    if data == OLD or path.suffix == ".fifo":
        return True
    if path.suffix == ".glb":
        return struct.unpack_from("<I", data, 8)[0] == len(data)
    if path.suffix == ".json":
        return bool(json.loads(data))
    if path.suffix == ".png":
        return data.endswith(b"IEND\xaeB`\x82")
    if path.suffix == ".html":
        return data.rstrip().endswith(b"</html>")
    return len(data) > 0


class Interrupts(unittest.TestCase):
    slowest = (0.0, "")

    @classmethod
    def tearDownClass(cls):
        print(f"\nslowest to end: {cls.slowest[0]:.2f} s, {cls.slowest[1]}")

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="wilt-interrupts-")
        self.dir = pathlib.Path(self.scratch.name)
        self.tmp = self.dir / "tmp"
        self.tmp.mkdir()

    def tearDown(self):
        self.assertEqual(list(self.tmp.iterdir()), [], "something was left in TMPDIR")
        self.scratch.cleanup()

    def start(self, *arguments, **options):
        return subprocess.Popen([WILT, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, "TMPDIR": str(self.tmp)}, **options)

    def end(self, process, name=""):
        start = time.monotonic()
        _, said = process.communicate(timeout=60)
        taken = time.monotonic() - start
        if taken > self.slowest[0]:
            Interrupts.slowest = (taken, name)
        self.assertEqual(voice.faults(said), [])
        return said

    def pipe(self, name):
        path = self.dir / name
        os.mkfifo(path)
        return path

    def stuck_in_writing(self, *others):
        """A run that waits with its first file half written; what it was written to, and the other end."""
        path = self.pipe("stuck.glb")
        reader = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        fcntl.fcntl(reader, fcntl.F_SETPIPE_SZ, 4096)
        process = self.start(*SHORT, "-o", path, *others)
        os.set_blocking(reader, True)
        first = b""
        while not first:  # nothing while nobody has opened the other end
            first = os.read(reader, 100)
            self.assertIsNone(process.poll())
        return process, reader, first

    def test_before_anything_is_computed_every_signal_ends_it(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            waiting = self.pipe(f"veins-{number}.json")
            process = self.start(*SHORT, "--veins", waiting, "-o", self.dir / "new.glb")
            with open(waiting, "wb"):  # opened when wilt reads it
                process.send_signal(number)
                said = self.end(process, "waiting for veins")
            self.assertEqual(process.returncode, 130, said)
            self.assertIn("error: interrupted; nothing more was written", said)
            self.assertFalse((self.dir / "new.glb").exists())

    def test_reading_writing_and_rendering_end_at_once(self):
        for verb, target in (("veins", "v.svg"), ("render", "p.png")):
            waiting = self.pipe(f"{verb}.{'json' if verb == 'veins' else 'glb'}")
            arguments = {"veins": ["veins", *LEAF, "--veins", waiting], "render": ["render", waiting]}[verb]
            process = self.start(*arguments, "-o", self.dir / target)
            with open(waiting, "wb"):
                process.send_signal(signal.SIGINT)
                said = self.end(process, verb)
            self.assertEqual(process.returncode, 130, said)

    def test_nohup_is_respected(self):
        waiting = self.pipe("veins.json")
        process = self.start("veins", *LEAF, "--veins", waiting, "-o", self.dir / "v.svg",
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        with open(waiting, "w") as pipe:
            process.send_signal(signal.SIGHUP)
            pipe.write(subprocess.run([WILT, "veins", *LEAF, "-q", "--json"], capture_output=True, text=True).stdout)
        said = self.end(process)
        self.assertEqual(process.returncode, 0, said)

    def test_the_file_that_is_being_written_is_finished(self):
        left_out = self.dir / "left-out.ply"
        left_out.write_bytes(OLD)
        process, reader, data = self.stuck_in_writing("-o", left_out)
        process.send_signal(signal.SIGINT)
        time.sleep(0.1)
        while more := os.read(reader, 1 << 16):
            data += more
        os.close(reader)
        said = self.end(process, "writing")
        self.assertEqual(process.returncode, 130, said)
        self.assertEqual(struct.unpack_from("<I", data, 8)[0], len(data), "the file is not whole")
        self.assertIn(f"interrupted while writing; not written: '{left_out}'", said)
        self.assertEqual(left_out.read_bytes(), OLD)

    def test_a_second_one_ends_it_at_once(self):
        left_out = self.dir / "left-out.ply"
        process, reader, _ = self.stuck_in_writing("-o", left_out)
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        said = self.end(process, "writing, twice")
        os.close(reader)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("interrupted again", said)
        self.assertFalse(left_out.exists())

    def test_a_run_that_is_stopped_writes_all_it_has(self):
        """Pictures too, which ask whether to stop while they are made."""
        files = [self.dir / name for name in ("a.glb", "a.ply", "r.json", "f.csv")]
        process = self.start("simulate", *LEAF, "--iterations", "1000000", "--set", "texture.size=64", "-o", files[0], "-o",
                             files[1], "--report", files[2], "--forces", files[3])
        for line in process.stderr:
            if "vein tip" in line:
                break
        time.sleep(0.5)
        process.send_signal(signal.SIGTERM)
        said = self.end(process, "withering")
        self.assertEqual(process.returncode, 130, said)
        self.assertRegex(said, "interrupted after iteration .*; what was computed until then was written")
        self.assertTrue(all(is_whole(file) for file in files))

    def test_random_moments(self):
        """Every verb, interrupted anywhere between its start and its end."""
        moments = random.Random(1)
        result = self.dir / "result.glb"
        subprocess.run([WILT, *SHORT, "-q", "-o", result], check=True)
        verbs = {"leaf": ["leaf", "grape", "--vertices", 2000, "-o", "{}/l.glb"],
                 "veins": ["veins", "maple", "--vertices", 4000, "-o", "{}/v.json"],
                 "simulate": ["simulate", "maple", "--vertices", 600, "--iterations", 12, "-o", "{}/s.glb", "-o", "{}/s.pvd",
                              "--report", "{}/s.json"],
                 "picture": ["render", result, "-o", "{}/p.png", "--size", "400x300", "--samples", 16],
                 "sheet": ["render", result, "-o", "{}/sheet.png", "--size", "160x120", "--samples", 4],
                 "film": ["render", result, "-o", "{}/m.mp4", "--size", "160x120", "--samples", 1],
                 "demo": ["demo", "-o", "{}"],
                 "reproduce": ["reproduce", "table2", "fig5", "-o", "{}", "--vertices", 300]}
        for verb, arguments in verbs.items():
            folder = self.dir / verb
            folder.mkdir()
            if verb not in ("demo", "reproduce"):
                target = pathlib.Path(str(arguments[arguments.index("-o") + 1]).format(folder))
                target.write_bytes(OLD)
            for latest in (0.1, 0.5, 1.0, 2.0):
                process = self.start(*(str(a).format(folder) for a in arguments))
                try:
                    process.wait(moments.uniform(0.02, latest))
                except subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGINT)
                said = self.end(process, verb)
                # A signal may come before the program's first line: then the system ends it.
                self.assertIn(process.returncode, (0, 130, -signal.SIGINT), f"{verb}: {said}")
                self.assertNotIn("what()", said)
                for file in folder.rglob("*"):
                    self.assertFalse(file.name.startswith("."), f"{verb} left {file}")
                    self.assertTrue(file.is_dir() or is_whole(file), f"{verb}: {file} is not whole")


if __name__ == "__main__":
    unittest.main()
