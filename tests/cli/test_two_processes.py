"""Two processes that write the same files at the same time do no harm: at every moment every file is whole and of one of
them, and nothing else is left behind.

Oracle: the bytes that each process writes when it is alone, file by file.
"""
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

WILT = pathlib.Path(sys.argv.pop(1)).resolve()
ROUNDS = 4


def files_in(folder):
    """Path -> bytes; what is gone before it is read is left out."""
    files = {}
    for path in folder.rglob("*"):
        try:
            if path.is_file() and not path.name.endswith(".tmp"):
                files[str(path.relative_to(folder))] = path.read_bytes()
        except FileNotFoundError:
            pass
    return files


class TwoProcesses(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def start(self, folder, arguments):
        return subprocess.Popen([WILT, *map(str, arguments), "-q"], cwd=folder, stderr=subprocess.PIPE, text=True)

    def finish(self, process):
        _, messages = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 0, messages)

    def check(self, *commands):
        """Runs the commands at once, again and again, in one folder."""
        alone = []
        for k, arguments in enumerate(commands):
            folder = self.dir / f"alone-{k}"
            folder.mkdir()
            self.finish(self.start(folder, arguments))
            alone.append(files_in(folder))
        self.assertGreater(len(alone[0]), 0)
        allowed = {name: {files[name] for files in alone if name in files} for files in alone for name in files}
        shared = self.dir / "shared"
        shared.mkdir()
        seen, over = [0], threading.Event()
        wrong = []

        def watch():
            while not over.is_set():
                for name, data in files_in(shared).items():
                    seen[0] += 1
                    if data not in allowed.get(name, ()):
                        wrong.append(f"{name}: {len(data)} bytes that neither process writes")

        watcher = threading.Thread(target=watch)
        watcher.start()
        try:
            for _ in range(ROUNDS):
                for process in [self.start(shared, arguments) for arguments in commands]:
                    self.finish(process)
        finally:
            over.set()
            watcher.join()
        self.assertEqual(wrong, [])
        self.assertGreater(seen[0], ROUNDS)
        self.assertEqual(sorted(str(p.relative_to(shared)) for p in shared.rglob("*") if p.is_file()), sorted(allowed))
        for name, data in files_in(shared).items():
            self.assertIn(data, allowed[name], name)

    def test_runs_of_two_leaves_into_the_same_files(self):
        names = ["m.glb", "m.usda", "m.pc2", "m.pvd", "m.vat.json", "m.obj", "s.##.obj", "s.##.ply"]
        outputs = [word for name in names for word in ("-o", name)]
        run = ["simulate", "ivy", "--vertices", 400, "--frames", 6, "--set", "texture.size=64", "--forces", "f.csv", *outputs]
        self.check([*run, "--iterations", 6, "--seed", 1], [*run, "--iterations", 8, "--seed", 2])

    def test_figures_into_one_folder(self):
        self.check(["reproduce", "table1", "table2", "fig2", "-o", "out"], ["reproduce", "table2", "fig2", "-o", "out"])

    def test_all_leaves_of_a_drawing_into_the_same_files(self):
        drawing = self.dir / "leaves.svg"
        shapes = "".join(f'<path d="M {x} 90 C {x - 40} 60 {x - 25} 20 {x} 5 C {x + 25} 20 {x + 40} 60 {x} 90 Z"/>' for x in (60, 180))
        drawing.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="240" height="100">{shapes}</svg>')
        run = ["leaf", drawing, "--leaf", "all", "-o", "leaf.obj"]
        self.check([*run, "--vertices", 300], [*run, "--vertices", 400])


if __name__ == "__main__":
    unittest.main()
