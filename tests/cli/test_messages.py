"""Wrong command lines of every kind: the exit code, one message, and how it reads (voice.py).

Oracle: the contract of the exit codes; the rules of voice.py, seen to fail on CLI11's own "Could not convert: --frames = x".
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import voice

WILT = sys.argv.pop(1)

# Exit code, arguments, a part of the message.
WRONG = [
    (2, ["simulat", "maple"], "unknown command 'simulat' (did you mean 'simulate'?)"),
    (2, ["-x"], "unknown option '-x'"),
    (2, ["species", "maple"], "'maple' is one word too many for `wilt species`"),
    (2, ["species", "--jsn"], "unknown option '--jsn' (did you mean '--json'?)"),
    (2, ["--color=blue", "species"], "--color takes one of auto, always, never, not 'blue'"),
    (2, ["--completion"], "--completion needs a value, SHELL"),
    (2, ["simulate", "maple", "-o"], "--output needs a value, FILE"),
    (2, ["simulate", "maple", "-o", "m.glb", "--iterations", "x"], "--iterations takes a whole number from 0 to 1000000, not 'x'"),
    (2, ["simulate", "maple", "-o", "m.glb", "--iterations", "1.5"], "takes a whole number"),
    (2, ["simulate", "maple", "-o", "m.glb", "--frames", "99999999999999999999"], "takes a whole number"),
    (2, ["simulate", "maple", "-o", "m.glb", "--vat", "foo"], "--vat takes one of exr, png, not 'foo'"),
    (2, ["simulate", "maple", "-o", "m.glb", "--checkpoint-every", "-1"], "takes a number from 0 to 86400, not '-1'"),
    (2, ["simulate", "maple", "-o", "m.glb", "--resume"], "--checkpoint FILE"),
    (2, ["simulate", "maple", "-o", "m.glb", "--model", "papr"], "did you mean 'paper'?"),
    (2, ["simulate", "maple", "-o", "m.glb", "--set", "dt"], "--set takes key=value, not 'dt'"),
    (2, ["simulate", "maple", "-o", "m.glb", "--set", "dt=fast"], "dt must be between"),
    (2, ["simulate", "maple", "-o", "m.glb", "--set", "dt=nan"], "dt must be between"),
    (2, ["simulate", "maple", "-o", "m.glb", "--set", "pin=rign"], "did you mean 'ring'?"),
    (2, ["simulate", "maple", "-o", "m.glb", "--set", "species=oak"], "oak"),
    (2, ["simulate", "maple", "-o", "m.glb", "--set", "veins.secondary=yes"], "must be true or false, not 'yes'"),
    (2, ["simulate", "maple", "-o", "m.glb", "--set", "vertices=7"], "must be 0 or between 200"),
    (2, ["simulate", "maple", "-o", "m.glb", "--seed", "-1"], "--seed takes a whole number"),
    (2, ["simulate", "maple", "-o", "m.glb", "--quiet=maybe"], "--quiet takes no value"),
    (2, ["simulate", "maple", "-o", "m.xyz"], "results are .glb"),
    (2, ["simulate", "maple", "-o", "m.#.obj", "-o", "m.obj"], "would both write"),
    (2, ["simulate", "maple"], "nothing would be written; add -o maple.glb"),
    (2, ["simulate", "-o", "m.glb"], "which leaf?"),
    (2, ["simulate", "maple", "-o", "m.glb", "--leaf", "2"], "go with a file, not with a species"),
    (2, ["leaf", "maple", "-o", "a.glb", "-o", "b.glb"], "--output was given more than once; give it once"),
    (2, ["leaf", "maple", "-o", "m.glb", "--vertices", "10"], "--vertices takes a whole number from 200 to 1000000, not '10'"),
    (2, ["leaf", "maple", "-o", "m.png"], "a leaf is .glb or .obj"),
    (2, ["leaf", "{drawing}", "-o", "m.glb", "--petiole", "here"], "--petiole takes two numbers, X,Y, not 'here'"),
    (2, ["leaf", "{drawing}", "-o", "m.glb", "--leaf", "0"], "takes a whole number from 1 to 10000, not '0'; or all"),
    (2, ["leaf"], "LEAF is missing"),
    (2, ["veins", "maple", "-o", "v.txt"], "veins are .json, .svg or .obj"),
    (2, ["render"], "FILE is missing"),
    (2, ["render", "{drawing}"], "--output is missing"),
    (2, ["render", "x.glb", "-o", "x.tiff"], "a picture or sheet is .png or .jpg"),
    (2, ["render", "x.glb", "-o", "x.png", "--size", "huge"], "--size takes two numbers like 1920x1080, not 'huge'"),
    (2, ["render", "x.glb", "-o", "x.png", "--size", "1x1"], "16 to 16384"),
    (2, ["render", "x.glb", "-o", "x.png", "--fps", "25"], "--fps does not go with a picture"),
    (2, ["render", "x.glb", "-o", "x.png", "--view", "0,100"], "-90 to 90 degrees"),
    (2, ["reproduce", "fig99", "-o", "r"], "unknown figure 'fig99'"),
    (3, ["leaf", "mapel", "-o", "m.glb"], "did you mean 'maple'?"),
    (3, ["leaf", "none.obj", "-o", "m.glb"], "there is no file 'none.obj'; check the path"),
    (3, ["info", "none.glb"], "there is no file 'none.glb'; check the path"),
    (3, ["info", "{text}"], "text"),
    (3, ["info", "."], ""),
    (3, ["render", "none.glb", "-o", "x.png"], "none.glb"),
    (3, ["render", "{drawing}", "-o", "x.png"], "give a .glb that wilt wrote"),
    (3, ["veins", "ivy", "--vertices", "200", "--veins", "{text}", "-o", "v.svg"], "give a file as `wilt veins"),
    (3, ["veins", "ivy", "--vertices", "200", "--veins", "{json}", "-o", "v.svg"], "json"),
    (3, ["simulate", "maple", "-o", "m.glb", "--config", "none.toml"], "none.toml"),
    (2, ["simulate", "maple", "-o", "m.glb", "--config", "{text}"], "text.txt, line 1: this is not TOML"),
    (5, ["simulate", "maple", "-o", "none/m.glb"], "make it (mkdir -p 'none')"),
    (5, ["leaf", "maple", "-o", "{folder}"], "it is a folder"),
]


class Messages(unittest.TestCase):
    def test_wrong_command_lines_are_refused_in_one_voice(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            given = {"drawing": "drawing.svg", "text": "text.txt", "json": "a.json", "folder": "folder.glb"}
            (folder / "drawing.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><circle r="50"/></svg>')
            (folder / "text.txt").write_text("not what it seems ]")
            (folder / "a.json").write_text(json.dumps({"veins": [{"order": 7}]}))
            (folder / "folder.glb").mkdir()
            before = sorted(p.name for p in folder.iterdir())
            for code, arguments, part in WRONG:
                with self.subTest(arguments=arguments):
                    arguments = [a.format(**given) for a in arguments]
                    said = subprocess.run([WILT, *arguments], capture_output=True, text=True, timeout=300, cwd=folder)
                    self.assertEqual(said.returncode, code, said.stderr)
                    self.assertIn(part, said.stderr)
                    self.assertEqual(said.stdout, "")
                    self.assertEqual([line[:7] for line in said.stderr.splitlines()].count("error: "), 1, said.stderr)
                    self.assertEqual(voice.faults(said.stderr), [])
            self.assertEqual(sorted(p.name for p in folder.iterdir()), before)

    def test_the_rules_notice_other_voices(self):
        for foreign in ("error: Could not convert: --frames = x", "error: filesystem error: std::bad_alloc; try again",
                        "error: cannot write it.", "error: it failed"):
            self.assertNotEqual(voice.faults(foreign), [], foreign)


if __name__ == "__main__":
    unittest.main()
