"""Every writer against every way in which writing fails: the exit code is 5, the message names the file and what to do,
an old file stays as it was, and no temporary file is left, neither beside it nor in TMPDIR. Prints the table.

Oracles: the contract of the exit code, the bytes of the old files, the listings of the folders before and after.
Seen to fail: ffmpeg that could not write the end of a film exits with 0, and half a film took the old one's place.
"""
import contextlib
import fcntl
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

import voice

WILT = sys.argv.pop(1)
OLD = b"the old file"
LEAF = ["ivy", "--vertices", "200"]
RUN = ["simulate", *LEAF, "--iterations", "2", "--frames", "2", "--set", "texture.size=64", "-q"]
FILM = ["--size", "64x48", "--samples", "1", "-q"]
IS_ROOT = os.geteuid() == 0

# Writer: the file that it is named after, and the arguments before that name.
WRITERS = {f"simulate {name}": (name, [*RUN, *extra, "-o"]) for name, extra in {
    "a.glb": [], "a.usda": [], "a.pvd": [], "a.vtu": [], "a.obj": [], "a.ply": [], "a.pc2": [], "a.mdd": [],
    "a.####.obj": [], "a.####.ply": [], "a.####.vtu": [], "a.vat.json": ["--lods", "1"]}.items()}
WRITERS["simulate a.vat.json --vat png"] = ("a.vat.json", [*RUN, "--vat", "png", "-o"])
WRITERS["simulate --report"] = ("r.json", [*RUN, "--report"])
WRITERS["simulate --forces"] = ("f.csv", [*RUN, "--forces"])
WRITERS |= {f"leaf {name}": (name, ["leaf", *LEAF, "-q", "-o"]) for name in ("l.glb", "l.obj")}
WRITERS |= {f"veins {name}": (name, ["veins", *LEAF, "-q", "-o"]) for name in ("v.json", "v.svg", "v.obj")}
WRITERS |= {f"render {name}": (name, ["render", "{result}", *FILM, "-o"])
            for name in ("p.png", "p.jpg", "sheet.png", "m.mp4", "m.webm", "m.gif")}
FOLDER_WRITERS = {"reproduce": ["reproduce", "table1", "-q", "-o"]}


def as_somebody():
    """Options of a process for whom permissions count."""
    return {"user": 65534} if IS_ROOT else {}


def limited(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def listing(folder):
    """Every file in the folder with its bytes; folders and links by their names."""
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() and not p.is_symlink() else None
            for p in sorted(folder.rglob("*"))}


class Mounted:
    """A small file system of its own, where root may mount one."""

    def __init__(self, folder, kibibytes):
        self.folder = folder
        folder.mkdir()
        self.ok = IS_ROOT and subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "tmpfs", folder],
                                             capture_output=True).returncode == 0

    def make_read_only(self):
        subprocess.run(["mount", "-o", "remount,ro", self.folder], check=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.ok:
            subprocess.run(["umount", self.folder], check=True)


class Writers(unittest.TestCase):
    table = {}

    @classmethod
    def setUpClass(cls):
        cls.base = tempfile.TemporaryDirectory(prefix="wilt-writers-")
        cls.dir = pathlib.Path(cls.base.name)
        cls.dir.chmod(0o755)
        cls.result = cls.dir / "result.glb"
        subprocess.run([WILT, *RUN, "-o", cls.result], check=True)
        cls.veins = cls.dir / "veins.json"
        subprocess.run([WILT, "veins", *LEAF, "-q", "-o", cls.veins], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.base.cleanup()
        columns = list(dict.fromkeys(c for row in cls.table.values() for c in row))
        width = max(map(len, cls.table), default=0)
        print("\n" + " " * width, *(f"{c:>16}" for c in columns))
        for writer, row in cls.table.items():
            print(f"{writer:{width}}", *(f"{row.get(c, ''):>16}" for c in columns))
        print("5 and the reason; - : not possible for this writer. Old files untouched and nothing left in all of them.")

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(dir=self.dir)
        self.place = pathlib.Path(self.scratch.name)
        self.place.chmod(0o755)
        self.tmp = self.place / "tmp"
        self.tmp.mkdir()
        self.tmp.chmod(0o777)

    def tearDown(self):
        self.assertEqual(list(self.tmp.iterdir()), [], "something was left in TMPDIR")
        self.scratch.cleanup()

    def run_writer(self, writer, folder, **options):
        name, arguments = WRITERS[writer]
        return self.run_wilt([*(a.format(result=self.result) for a in arguments), str(folder / name)], **options)

    def run_wilt(self, arguments, **options):
        return subprocess.run([WILT, *arguments], capture_output=True, text=True, timeout=300,
                              env={**os.environ, "TMPDIR": str(self.tmp)}, **options)

    def expect_refusal(self, writer, failure, result, names):
        """Exit code 5, one message on stderr that names a file and a remedy."""
        said = result.stderr.strip().splitlines()
        with self.subTest(writer=writer, failure=failure):
            self.assertEqual(result.returncode, 5, result.stderr)
            self.assertTrue(any(line.startswith("error: cannot write") for line in said), result.stderr)
            self.assertIn(names, result.stderr)
            self.assertEqual(voice.faults(result.stderr), [])
            self.assertFalse(said[-1].endswith("."), said[-1])
            reason = re.search(r"cannot write '[^']*': ([^:;]*)", said[-1])
            self.table.setdefault(writer, {})[failure] = f"5 {reason.group(1)[:14] if reason else '?'}"

    def old_files(self, writer, folder):
        """What an earlier run of the writer left, marked as old."""
        done = self.run_writer(writer, folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        files = [p for p in folder.iterdir() if p.is_file()]
        self.assertTrue(files)
        for file in files:
            file.write_bytes(OLD)
        return listing(folder)

    def test_a_full_disk(self):
        for number, writer in enumerate(WRITERS):
            with Mounted(self.place / f"disk-{number}", 4096) as disk:
                if not disk.ok:
                    self.skipTest("only root may mount a small disk; the limit on file sizes stands for it")
                before = self.old_files(writer, disk.folder)
                filler = os.open(disk.folder / "filler", os.O_WRONLY | os.O_CREAT)
                with contextlib.suppress(OSError):
                    while True:
                        os.write(filler, b"x" * 4096)
                os.close(filler)
                before["filler"] = (disk.folder / "filler").read_bytes()
                result = self.run_writer(writer, disk.folder)
                self.expect_refusal(writer, "disk full", result, "No space left on device")
                self.assertEqual(listing(disk.folder), before, writer)

    def test_a_limit_on_the_size_of_files(self):
        for number, writer in enumerate(WRITERS):
            folder = self.place / str(number)
            folder.mkdir()
            before = self.old_files(writer, folder)
            result = self.run_writer(writer, folder, preexec_fn=limited(256))
            self.expect_refusal(writer, "file size limit", result, "")
            self.assertEqual(listing(folder), before, writer)

    def test_a_folder_that_may_not_be_written_to(self):
        for number, writer in enumerate(WRITERS):
            folder = self.place / str(number)
            folder.mkdir()
            before = self.old_files(writer, folder)
            for file in folder.iterdir():
                file.chmod(0o444)
            folder.chmod(0o555)
            result = self.run_writer(writer, folder, **as_somebody())
            self.expect_refusal(writer, "read-only folder", result, str(folder))
            self.assertEqual(listing(folder), before, writer)
            folder.chmod(0o755)

    def test_a_read_only_disk(self):
        for number, writer in enumerate(WRITERS):
            with Mounted(self.place / f"disk-{number}", 4096) as disk:
                if not disk.ok:
                    self.skipTest("only root may mount a disk")
                before = self.old_files(writer, disk.folder)
                disk.make_read_only()
                result = self.run_writer(writer, disk.folder)
                self.expect_refusal(writer, "read-only disk", result, "Read-only file system")
                self.assertEqual(listing(disk.folder), before, writer)

    def test_a_folder_in_its_place(self):
        for number, writer in enumerate(WRITERS):
            if "####" in writer:
                continue
            folder = self.place / str(number)
            (folder / WRITERS[writer][0]).mkdir(parents=True)
            result = self.run_writer(writer, folder)
            self.expect_refusal(writer, "is a folder", result, WRITERS[writer][0])
            self.assertEqual(listing(folder), {WRITERS[writer][0]: None}, writer)

    def test_a_device_that_is_full(self):
        """Written in place, through a link: what else the writer makes beside it may have been written."""
        for number, writer in enumerate(WRITERS):
            if "####" in writer:
                continue
            folder = self.place / str(number)
            folder.mkdir()
            (folder / WRITERS[writer][0]).symlink_to("/dev/full")
            result = self.run_writer(writer, folder)
            self.expect_refusal(writer, "/dev/full", result, "No space left on device")
            self.assertFalse([p for p in folder.iterdir() if p.name.startswith(".")], writer)

    def test_a_pipe_whose_reader_goes(self):
        for number, writer in enumerate(WRITERS):
            if "####" in writer:
                continue
            folder = self.place / str(number)
            folder.mkdir()
            pipe = folder / WRITERS[writer][0]
            os.mkfifo(pipe)
            reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
            fcntl.fcntl(reader, fcntl.F_SETPIPE_SZ, 4096)
            process = subprocess.Popen([WILT, *(a.format(result=self.result) for a in WRITERS[writer][1]), pipe],
                                       stderr=subprocess.PIPE, text=True, env={**os.environ, "TMPDIR": str(self.tmp)})
            os.set_blocking(reader, True)
            while not os.read(reader, 10):  # nothing while nobody has opened the other end
                if process.poll() is not None:
                    break
            os.close(reader)
            _, said = process.communicate(timeout=300)
            result = subprocess.CompletedProcess([], process.returncode, "", said)
            if result.returncode == 0:  # all of it fitted into the pipe
                self.table.setdefault(writer, {})["closed pipe"] = "0 fitted"
                continue
            self.expect_refusal(writer, "closed pipe", result, "Broken pipe")

    def test_a_folder_that_vanishes_during_the_run(self):
        """The run waits for its --veins or its result while the folder is taken away."""
        for number, writer in enumerate(WRITERS):
            name, arguments = WRITERS[writer]
            if writer.startswith("leaf"):
                continue  # reads nothing that could wait
            folder = self.place / str(number)
            folder.mkdir()
            source = self.result if writer.startswith("render") else self.veins
            waiting = self.place / f"{number}{source.suffix}"
            os.mkfifo(waiting)
            arguments = [a.format(result=waiting) for a in arguments]
            if source == self.veins:
                arguments[-1:-1] = ["--veins", str(waiting)]
            process = subprocess.Popen([WILT, *arguments, folder / name], stderr=subprocess.PIPE, text=True,
                                       env={**os.environ, "TMPDIR": str(self.tmp)})
            with open(waiting, "wb") as pipe:
                folder.rmdir()
                pipe.write(source.read_bytes())
            _, said = process.communicate(timeout=300)
            result = subprocess.CompletedProcess([], process.returncode, "", said)
            self.expect_refusal(writer, "folder vanished", result, "make it (mkdir -p")
            self.assertFalse(folder.exists(), writer)

    def test_without_files_that_have_no_name(self):
        """Where the system cannot name an unnamed file (here: without /proc), a named one does as well."""
        folder = self.place / "plain"
        folder.mkdir()
        shell = 'mount -t tmpfs none /proc && exec "$0" "$@"'
        plain = ["unshare", "--mount", "sh", "-c", shell, WILT, "veins", *LEAF, "-q", "-o", str(folder / "v.json")]
        if not IS_ROOT or subprocess.run(plain, capture_output=True).returncode != 0:
            self.skipTest("only root may hide /proc")
        self.assertEqual(listing(folder), {"v.json": self.veins.read_bytes()})

    def test_the_list_of_a_sequence_comes_last(self):
        """A list never names a file that is not there: with room for half, no list is written."""
        for name in ("a.pvd", "a.vat.json"):
            whole = self.place / f"whole-{name}"
            whole.mkdir()
            self.assertEqual(self.run_wilt([*RUN, "-o", str(whole / name)]).returncode, 0)
            needed = sum(-(-p.stat().st_size // 4096) * 4 for p in whole.iterdir())
            with Mounted(self.place / f"disk-{name}", needed // 2) as disk:
                if not disk.ok:
                    self.skipTest("only root may mount a small disk")
                result = self.run_wilt([*RUN, "-o", str(disk.folder / name)])
                self.assertEqual(result.returncode, 5, result.stderr)
                self.assertNotEqual(list(disk.folder.iterdir()), [], "the disk took nothing: not half way")
                self.assertFalse((disk.folder / name).exists())

    def test_one_file_that_cannot_be_written_keeps_no_other_from_it(self):
        pipe = self.place / "full.glb"
        pipe.symlink_to("/dev/full")
        good, report = self.place / "good.ply", self.place / "r.json"
        result = self.run_wilt([*RUN, "-o", str(pipe), "-o", str(good), "--report", str(report)])
        self.assertEqual(result.returncode, 5)
        self.assertIn("full.glb", result.stderr)
        self.assertTrue(good.exists())
        json.loads(report.read_text())

    def test_folders(self):
        """The verbs that make a folder of files; demo makes its own by the same functions."""
        self.assertTrue(shutil.which("gnuplot"), "reproduce needs gnuplot")
        for writer, arguments in FOLDER_WRITERS.items():
            in_file = self.place / "file"
            in_file.write_bytes(OLD)
            self.expect_refusal(writer, "is a file", self.run_wilt([*arguments, str(in_file)]), str(in_file))
            self.assertEqual(in_file.read_bytes(), OLD)
            locked = self.place / "locked"
            locked.mkdir()
            locked.chmod(0o555)
            for place in (locked, locked / "new"):
                self.expect_refusal(writer, "read-only folder", self.run_wilt([*arguments, str(place)], **as_somebody()),
                                    str(place))
            self.assertEqual(listing(locked), {})
            limited_to = self.place / "small"
            result = self.run_wilt([*arguments, str(limited_to)], preexec_fn=limited(256))
            self.expect_refusal(writer, "file size limit", result, "claims.csv")
            self.assertEqual(listing(limited_to), {})
        for place in (in_file, locked, locked / "new"):
            result = self.run_wilt(["demo", "-q", "-o", str(place)], **as_somebody())
            self.expect_refusal("demo", "is a file" if place == in_file else "read-only folder", result, str(place))


if __name__ == "__main__":
    unittest.main()
