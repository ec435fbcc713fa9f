"""stdout and stderr that take nothing: exit code 5 for data that is lost, never a crash, never a file spoilt.

Oracles: the contract of the exit code; every line of a written OBJ is one of the format's. Seen to fail: a program
that writes messages by fmt::print aborts where stderr takes none, and one that leaves stdout to exit says 0.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

WILT = sys.argv.pop(1)


class StandardStreams(unittest.TestCase):
    def shell(self, command):
        return subprocess.run(["bash", "-c", command.replace("wilt", WILT, 1)], capture_output=True, text=True, timeout=300)

    def test_data_that_stdout_does_not_take_is_an_error(self):
        for command in ("wilt --help", "wilt", "wilt --version", "wilt species", "wilt species --json",
                        "wilt simulate --help", "wilt simulate maple --print-config",
                        "wilt leaf ivy --vertices 200 -q --json", "wilt veins ivy --vertices 200 -q --json"):
            for place in (">/dev/full", ">&-"):
                result = self.shell(f"{command} {place}")
                self.assertEqual(result.returncode, 5, command + place + result.stderr)
                self.assertTrue(result.stderr.startswith("error: cannot write to the standard output: "), result.stderr)
                self.assertEqual(result.stderr.count("\n"), 1)

    def test_a_reader_that_goes_is_an_error(self):
        result = self.shell("wilt veins ivy --vertices 2000 -q --json | head -c 10; exit ${PIPESTATUS[0]}")
        self.assertEqual(result.returncode, 5, result.stderr)
        self.assertIn("Broken pipe", result.stderr)

    def test_messages_that_nobody_takes_are_no_error(self):
        with tempfile.TemporaryDirectory() as folder:
            for place in ("2>/dev/full", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
                file = pathlib.Path(folder) / "leaf.obj"
                result = self.shell(f"wilt leaf ivy --vertices 200 -v -o {file} {place}")
                self.assertEqual(result.returncode, 0, place)
                lines = file.read_text().splitlines()
                self.assertTrue(all(line == "" or line.split()[0] in "# mtllib o g s v vt vn f usemtl".split()
                                    for line in lines), "a message is in the file")
                file.unlink()
            self.assertEqual(self.shell("wilt leaf mapel -o x.glb 2>&-").returncode, 3)


if __name__ == "__main__":
    unittest.main()
