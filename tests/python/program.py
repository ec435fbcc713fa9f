"""The program wilt, which the module is compared with."""
import os
import pathlib
import subprocess
import tempfile
import unittest

WILT = os.environ["WILT"]


def wilt(*arguments, cwd=None):
    return subprocess.run([WILT, *map(str, arguments)], capture_output=True, text=True, timeout=600, cwd=cwd)


class WithFolder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.dir = pathlib.Path(folder.name)

    def program(self, *arguments):
        """Runs the program in the folder, where it must succeed."""
        done = wilt(*arguments, cwd=self.dir)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done
