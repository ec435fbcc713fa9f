"""docs/troubleshooting.md quotes what the program says: its commands are run, and every line under them must appear.

Oracle: the page. A line of the page is the beginning of a line that the program writes.
"""
import math
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

WILT = os.path.abspath(sys.argv.pop(1))
PAGE = pathlib.Path(sys.argv.pop(1)) / "docs/troubleshooting.md"
QUICK = " --iterations 1 --frames 2 --set texture.size=16"


def picture(width, height, colour):
    rows = b"".join(b"\0" + b"".join(bytes(colour(x, y)) for x in range(width)) for y in range(height))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def lawn():
    noise = random.Random(1)
    return picture(400, 300, lambda x, y: (60 + noise.randrange(80), 100 + noise.randrange(100), 30 + noise.randrange(50)))


def oval(half_length, steps=20):
    """A grid of quads on an oval, as OBJ."""
    lines = []
    for j in range(steps + 1):
        for i in range(steps + 1):
            u, v = 2 * i / steps - 1, 2 * j / steps - 1
            lines.append(f"v {u * math.sqrt(1 - v * v / 2) * half_length} {0.6 * v * math.sqrt(1 - u * u / 2) * half_length} 0")
    row = steps + 1
    lines += [f"f {a} {a + 1} {a + row + 1} {a + row}" for j in range(steps) for i in range(steps) for a in [j * row + i + 1]]
    return "\n".join(lines) + "\n"


BOX = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + "".join(
    f"f {face}\n" for face in ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"))
DRAWING = ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 100">'
           '<ellipse cx="100" cy="50" rx="90" ry="30" fill="green"/></svg>')


class Page(unittest.TestCase):
    def test_what_it_quotes_is_what_the_program_says(self):
        blocks = re.findall(r"^    \$ (.*)\n((?:    (?!\$).*\n)+)", PAGE.read_text(), re.MULTILINE)
        self.assertGreaterEqual(len(blocks), 12)
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "lawn.png").write_bytes(lawn())
            (place / "drawing.svg").write_text(DRAWING)
            (place / "leaf.obj").write_text(oval(50))
            (place / "box.obj").write_text(BOX)
            subprocess.run([WILT, "simulate", "ivy", "--vertices", "200", *QUICK.split(), "-o", place / "mine.glb", "-q"],
                           check=True)
            for command, lines in blocks:
                run = command.replace("wilt ", f"'{WILT}' ", 1)
                if " simulate " in command:
                    run += QUICK.replace("1", "3", 1)
                said = subprocess.run(["/bin/bash", "-c", run], cwd=place, capture_output=True, text=True, timeout=300)
                code = said.returncode
                for line in map(str.strip, lines.splitlines()):
                    self.assertTrue(any(s.startswith(line) for s in said.stderr.splitlines()),
                                    f"$ {command}\nthe page says:    {line}\nthe program says: {said.stderr}")
                    self.assertEqual(code != 0, line.startswith("error: "), command)


if __name__ == "__main__":
    unittest.main()
