"""The program as the linker left it: position-independent, relocations read-only and bound at once, no executable stack,
stack protector and checked library calls in it.

Oracle: readelf. Seen to fail on a program built without the flags. Skipped where the build has WILT_HARDENING off (sanitizers).
"""
import shutil
import subprocess
import sys
import unittest

HARDENED = sys.argv.pop() == "1"
WILT = sys.argv.pop()


def readelf(*options):
    return subprocess.run(["readelf", "--wide", *options, WILT], capture_output=True, text=True, check=True).stdout


class Hardening(unittest.TestCase):
    def test_the_program_is_built_as_promised(self):
        self.assertIn("Type:                              DYN", readelf("--file-header"))
        segments = readelf("--segments")
        self.assertIn("GNU_RELRO", segments)
        stack = next(line for line in segments.splitlines() if "GNU_STACK" in line)
        self.assertNotIn("E", stack.split("0x")[-2], stack)
        self.assertIn("BIND_NOW", readelf("--dynamic"))
        symbols = readelf("--dyn-syms")
        self.assertIn("__stack_chk_fail", symbols)
        self.assertRegex(symbols, r"__\w+_chk@")


if __name__ == "__main__":
    if not HARDENED or not shutil.which("readelf"):
        print("skipped: built without WILT_HARDENING, or readelf is not there")
        sys.exit(77)
    unittest.main()
