"""wilt render: what the files hold, and what is said when they cannot be made."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

WILT = pathlib.Path(sys.argv.pop(1)).resolve()
SMALL = ["--size", "96x64", "--samples", "4"]


def png_size(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        subprocess.run([WILT, "simulate", "poplar", "--vertices", "300", "--iterations", "20", "--frames", "5", "-q",
                        "--set", "clip.seconds=1", "-o", cls.folder / "poplar.glb"], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_wilt(self, *arguments, environment=None):
        return subprocess.run([WILT, "render", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, **(environment or {})})

    def render(self, name, *arguments):
        done = self.run_wilt("poplar.glb", "-o", name, *SMALL, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "")
        return self.folder / name

    def refused(self, code, *arguments, environment=None):
        done = self.run_wilt(*arguments, environment=environment)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_a_picture_has_its_size_and_is_of_the_last_frame(self):
        last = self.render("last.png")
        self.assertEqual(png_size(last), (96, 64))
        self.assertEqual(last.read_bytes(), self.render("four.png", "--frame", "4").read_bytes())
        self.assertNotEqual(last.read_bytes(), self.render("first.png", "--frame", "0").read_bytes())

    def test_the_defaults_are_those_that_help_names(self):
        plain = self.render("plain.png").read_bytes()
        self.assertEqual(plain, self.render("said.png", "--view=-75,45").read_bytes())

    def test_json_says_what_was_made(self):
        done = self.run_wilt("poplar.glb", "-o", "UPPER.PNG", *SMALL, "--json")
        self.assertEqual(json.loads(done.stdout), {"file": "UPPER.PNG", "kind": "picture"})

    def test_the_bytes_do_not_depend_on_threads_but_on_view_and_sun(self):
        one = self.render("one.png", "--threads", "1").read_bytes()
        self.assertEqual(one, self.render("two.png", "--threads", "2").read_bytes())
        self.assertNotEqual(one, self.render("top.png", "--view", "-90,90").read_bytes())
        self.assertNotEqual(one, self.render("low.png", "--sun", "90,20").read_bytes())

    def test_a_sheet_has_its_columns(self):
        self.assertEqual(png_size(self.render("sheet.png")), (4 * 96, 2 * 64))  # five frames
        self.assertEqual(png_size(self.render("strip.png", "--columns", "3", "--frames", "3")), (3 * 96, 64))

    @unittest.skipUnless(shutil.which("ffprobe"), "ffmpeg is not installed")
    def test_a_film_lasts_as_long_as_the_clip(self):
        for name, codec in (("film.mp4", "h264"), ("film.webm", "vp9"), ("film.gif", "gif")):
            film = self.render(name, "--fps", "10")
            probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                    "stream=codec_name,width,height,nb_read_frames", "-of", "csv=p=0", film],
                                   check=True, capture_output=True, text=True)
            self.assertEqual(probe.stdout.strip(), f"{codec},96,64,11", name)

    def test_wrong_requests_are_refused_with_what_is_allowed(self):
        self.assertIn("frames 0 to 4", self.refused(2, "poplar.glb", "-o", "x.png", "--frame", "5"))
        self.assertIn(".mp4", self.refused(2, "poplar.glb", "-o", "x.tiff"))
        self.assertIn("1920x1080", self.refused(2, "poplar.glb", "-o", "x.png", "--size", "big"))
        self.assertIn("16 to 16384", self.refused(2, "poplar.glb", "-o", "x.png", "--size", "8x9"))
        self.assertIn("--view takes two numbers", self.refused(2, "poplar.glb", "-o", "x.png", "--view", "top"))
        self.assertIn("--columns does not go with a film", self.refused(2, "poplar.glb", "-o", "x.mp4", "--columns", "3"))
        self.assertIn("--frame does not go with a contact sheet", self.refused(2, "poplar.glb", "-o", "sheet.png", "--frame", "1"))
        self.assertIn("--fps does not go with a picture", self.refused(2, "poplar.glb", "-o", "x.png", "--fps", "9"))
        self.assertIn("-90 to 90 degrees", self.refused(2, "poplar.glb", "-o", "x.png", "--view", "0,91"))
        (self.folder / "folder.png").mkdir()
        self.assertIn("it is a folder", self.refused(5, "poplar.glb", "-o", "folder.png"))
        self.assertIn("absent.glb", self.refused(3, "absent.glb", "-o", "x.png"))
        self.assertIn("the folder 'absent' does not exist", self.refused(5, "poplar.glb", "-o", "absent/x.png"))
        self.assertFalse((self.folder / "x.png").exists())

    def test_without_ffmpeg_it_says_what_to_install(self):
        self.assertIn("apt-get install ffmpeg",
                      self.refused(5, "poplar.glb", "-o", "x.mp4", *SMALL, environment={"PATH": "/nonexistent"}))

    def test_a_film_that_fails_leaves_the_old_one(self):
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "ffmpeg").write_text("#!/bin/sh\necho 'no such codec' >&2\nexit 1\n")
        (tools / "ffmpeg").chmod(0o755)
        (self.folder / "old.mp4").write_text("old")
        message = self.refused(5, "poplar.glb", "-o", "old.mp4", *SMALL,
                               environment={"PATH": f"{tools}:{os.environ['PATH']}", "TMPDIR": str(self.folder)})
        self.assertIn("no such codec", message)
        self.assertEqual((self.folder / "old.mp4").read_text(), "old")
        self.assertEqual(list(self.folder.glob("wilt-*")), [])


if __name__ == "__main__":
    unittest.main()
