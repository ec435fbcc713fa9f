"""The command line as a user meets it: exit codes, messages on stderr, data on stdout, files whole or not at all.

Oracles: the contract of the exit codes (0, 2, 3, 5), JSON parsers, byte comparison of files.
"""
import csv
import json
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import voice

WILT = sys.argv.pop(1)


def wilt(*arguments, **options):
    return subprocess.run([WILT, *map(str, arguments)], capture_output=True, text=True, timeout=600, **options)


def two_leaves():
    """A PNG of two pointed leaves, green on white."""
    rows = bytearray()
    for y in range(300):
        rows.append(0)
        for x in range(500):
            inside = any(abs(x - cx) < 60 * scale and abs(y - 150) < 70 * scale * (1 - (abs(x - cx) / (60 * scale)) ** 1.5)
                         for cx, scale in ((130, 1.5), (360, 1.0)))
            rows += bytes((60, 130, 40) if inside else (240, 240, 238))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", 500, 300, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows)))
            + chunk(b"IEND", b""))


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def expect(self, code, *arguments, says="", **options):
        result = wilt(*arguments, **options)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertIn(says, result.stderr)
        self.assertEqual(voice.faults(result.stderr), [])
        return result

    def test_help_shows_examples_first_and_goes_to_stdout(self):
        for verb in ([], ["demo"], ["species"], ["leaf"], ["veins"], ["simulate"], ["render"], ["reproduce"], ["info"], ["view"]):
            result = self.expect(0, *verb, "--help")
            self.assertLess(result.stdout.index("Examples:"), result.stdout.index("Options:"), verb)
            self.assertEqual(result.stderr, "")
        self.assertIn("Examples:", self.expect(0).stdout)
        self.assertRegex(self.expect(0, "--version").stdout, r"^wilt \d+\.\d+\.\d+")

    def test_wrong_command_lines_exit_2_with_the_nearest_word(self):
        self.expect(2, "simulat", "maple", says="did you mean 'simulate'?")
        self.expect(2, "simulate", "maple", "-o", "m.glb", "--itertions=5", says="did you mean '--iterations'?")
        self.expect(2, "simulate", "maple", "-o", "m.glb", "--set", "water.humidty=1", says="did you mean 'water.humidity'?")
        self.expect(2, "simulate", "maple", "-o", "m.glb", "--set", "dt=7", says="between 0.0001 and 1")
        self.expect(2, "simulate", "maple", "-o", "m.glb", "--model", "papr", says="did you mean 'paper'?")
        self.expect(2, "simulate", "maple", "-o", "m.xyz", says="results are .glb")
        self.expect(2, "simulate", "maple", says="nothing would be written")
        self.expect(2, "leaf", "maple", "--vertices", "10", "-o", "m.glb", says="--vertices")
        self.expect(2, "veins", "maple", "-o", "veins.txt", says=".json, .svg or .obj")

    def test_unusable_leaves_exit_3(self):
        self.expect(3, "leaf", "mapel", "-o", "m.glb", says="did you mean 'maple'?")
        self.expect(3, "leaf", self.dir / "none.obj", "-o", "m.glb", says="there is no file")
        broken = self.dir / "broken.obj"
        broken.write_text("v 0 0 0\nv 1 0 0\n")
        self.expect(3, "leaf", broken, "-o", self.dir / "m.glb", says="broken.obj")
        photo = self.dir / "leaf.jpg"
        photo.write_bytes(b"not yet")
        self.expect(3, "leaf", photo, "-o", self.dir / "m.glb", says="give a PNG or a JPEG")

    def test_all_leaves_of_a_photo_get_files_of_their_own(self):
        photo = self.dir / "two.png"
        photo.write_bytes(two_leaves())
        result = self.expect(0, "leaf", photo, "--leaf", "all", "-o", self.dir / "leaf.obj", "--vertices", 300)
        self.assertIn("the scale is unknown", result.stderr)
        sizes = [(self.dir / f"leaf-{n}.obj").read_text().count("\nv ") for n in (1, 2)]
        self.assertTrue(all(abs(size - 300) < 20 for size in sizes), sizes)
        self.assertFalse((self.dir / "leaf-3.obj").exists())
        self.expect(2, "leaf", photo, "--leaf", "all", "--petiole", "10,10", "-o", self.dir / "leaf.obj", says="--leaf N")
        self.expect(3, "leaf", photo, "--leaf", 3, "-o", self.dir / "leaf.obj", says="shows 2")
        self.expect(2, "leaf", photo, "--mm-per-unit", 2, "-o", self.dir / "leaf.obj", says="goes with a scan")

    def test_what_cannot_be_written_exits_5_before_the_work(self):
        self.expect(5, "simulate", "maple", "-o", self.dir / "missing" / "m.glb", says="mkdir -p")
        self.assertEqual(list(self.dir.iterdir()), [])

    def test_json_on_stdout_and_messages_on_stderr(self):
        species = json.loads(self.expect(0, "species", "--json").stdout)
        self.assertEqual([s["name"] for s in species], ["maple", "poplar", "tilia", "ivy", "willow", "grape"])
        leaf = json.loads(self.expect(0, "leaf", "ivy", "--vertices", 400, "--json").stdout)
        self.assertAlmostEqual(leaf["vertices"], 400, delta=20)
        self.assertGreaterEqual(leaf["smallest_angle_deg"], 20)
        veins = json.loads(self.expect(0, "veins", "ivy", "--vertices", 400, "--json").stdout)
        self.assertEqual(set(veins), {"leaf", "petiole", "margin", "tips", "veins"})
        self.assertEqual(len(veins["margin"]["s"]), veins["leaf"]["boundary_vertices"])
        quiet = self.expect(0, "leaf", "ivy", "--vertices", 400, "-o", self.dir / "ivy.glb", "-q")
        self.assertEqual(quiet.stderr + quiet.stdout, "")

    def test_report_and_forces_hold_what_the_contract_names(self):
        report, forces = self.dir / "report.json", self.dir / "forces.csv"
        self.expect(0, "simulate", "grape", "--vertices", 400, "--iterations", 10, "--frames", 3, "--report", report,
                    "--forces", forces)
        data = json.loads(report.read_text())
        for key in ("wilt", "config", "leaf", "timings_s", "steps", "frames", "metrics", "positions_hash"):
            self.assertIn(key, data)
        self.assertEqual(set(data["timings_s"]), {"leaf", "geodesics", "embedding", "venation", "simulation", "output"})
        self.assertEqual([f["iteration"] for f in data["frames"]], [0, 5, 10])
        self.assertEqual(data["metrics"], data["frames"][-1])
        self.assertEqual([s["iteration"] for s in data["steps"]], list(range(1, 11)))
        for key in ("dt", "newton", "linear", "residual", "converged", "kinetic", "elastic", "bending", "water"):
            self.assertIn(key, data["steps"][0])
        rows = list(csv.DictReader(forces.open()))
        self.assertEqual(list(rows[0]), ["iteration", "region", "elastic", "damping", "swelling", "external", "water", "pressure"])
        self.assertEqual({r["region"] for r in rows}, {"tip", "vein", "margin", "mesophyll"})
        self.assertEqual(len(rows), 4 * 11)
        self.assertNotIn(str(self.dir), report.read_text())

    def test_the_resolved_configuration_gives_the_same_bytes(self):
        first, second, config = self.dir / "a.glb", self.dir / "b.glb", self.dir / "run.toml"
        arguments = ["--vertices", 500, "--seed", 7, "--iterations", 12, "--set", "water.humidity=0.31"]
        self.expect(0, "simulate", "willow", *arguments, "-o", first, "--threads", 1)
        config.write_text(self.expect(0, "simulate", "willow", *arguments, "--print-config").stdout)
        self.expect(0, "simulate", "willow", "--config", config, "-o", second, "--threads", 2)
        self.assertEqual(first.read_bytes(), second.read_bytes())

    def test_settings_change_in_a_run(self):
        """Oracles: air that is saturated takes nothing; the resolved configuration gives the bytes again."""
        config, report, resolved = (self.dir / name for name in ("run.toml", "report.json", "resolved.toml"))
        config.write_text("iterations = 9\n[[change]]\niteration = 6\n\"water.humidity\" = 1\n")
        arguments = ["simulate", "ivy", "--vertices", 300, "--report", report, "--config"]
        self.expect(0, *arguments, config)
        data = json.loads(report.read_text())
        self.assertEqual(data["config"]["change"], [{"iteration": 6, "water.humidity": 1}])
        water = [step["water"] for step in data["steps"]]
        lost = [before - after for before, after in zip(water, water[1:])]
        self.assertTrue(all(some > 0.01 for some in lost[:5]) and max(map(abs, lost[5:])) < 1e-9, lost)
        resolved.write_text(self.expect(0, *arguments, config, "--print-config").stdout)
        self.assertIn("[[change]]\niteration = 6\n\"water.humidity\" = 1\n", resolved.read_text())
        self.expect(0, *arguments, resolved)
        self.assertEqual(json.loads(report.read_text())["positions_hash"], data["positions_hash"])
        config.write_text("[[change]]\niteration = 6\ndt = 0.2\n")
        self.expect(2, *arguments, config, says="run.toml, line 3: dt cannot change in a run")
        config.write_text("[[change]]\niteration = 100\nwater.humidity = 0.2\n")
        self.expect(0, *arguments, config, "--iterations", 1, says="after iteration 100 never comes")

    def test_settings_that_are_lists(self):
        """Oracle: Table 2's variant a, given as numbers."""
        forces = "0,0,.04,0,0,.04,.01,.01,.04,.03,-.03,.03,-.02,.01,.04,0,0,.04,0,0,.04"
        arguments = ["simulate", "maple", "--vertices", 300, "--iterations", 3, "--json"]
        hashes = {json.loads(self.expect(0, *arguments, "--set", f"external.forces={text}").stdout)["positions_hash"]
                  for text in (forces, "")}
        self.assertEqual(len(hashes), 1)
        self.expect(2, *arguments, "--set", "external.forces=0,0,1", says="the leaf has 7 tips: give 21")
        self.expect(2, *arguments, "--set", "water.dry_region=0,0,1,1", says="6 numbers or more")

    def test_a_wrong_configuration_file_is_named_with_its_line(self):
        config = self.dir / "run.toml"
        config.write_text("dt = 0.1\n[water]\nhumidty = 0.5\n")
        self.expect(2, "simulate", "ivy", "-o", self.dir / "m.glb", "--config", config, says="run.toml, line 3")
        self.expect(3, "simulate", "ivy", "-o", self.dir / "m.glb", "--config", self.dir / "none.toml", says="none.toml")

    def test_a_mesh_keeps_its_vertices_unless_told_otherwise(self):
        obj = self.dir / "leaf.obj"
        self.expect(0, "leaf", "poplar", "--vertices", 700, "-o", obj)
        own = json.loads(self.expect(0, "leaf", obj, "--json").stdout)["vertices"]
        self.assertAlmostEqual(own, 700, delta=35)
        report = self.dir / "r.json"
        self.expect(0, "simulate", obj, "--iterations", 2, "--report", report)
        self.assertEqual(json.loads(report.read_text())["leaf"]["vertices"], own)
        remeshed = json.loads(self.expect(0, "leaf", obj, "--vertices", 1500, "--json").stdout)["vertices"]
        self.assertAlmostEqual(remeshed, 1500, delta=75)

    def test_interrupting_keeps_what_was_computed_and_exits_130(self):
        glb, report = self.dir / "m.glb", self.dir / "r.json"
        process = subprocess.Popen([WILT, "simulate", "maple", "--vertices", "1000", "--iterations", "1000000", "-o",
                                    str(glb), "--report", str(report)], stderr=subprocess.PIPE, text=True)
        for line in process.stderr:  # the veins are found: from here on it withers
            if "vein tips" in line:
                break
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 130, messages)
        self.assertIn("interrupted after iteration", messages)
        data = json.loads(report.read_text())
        self.assertEqual(data["frames"][-1]["iteration"], len(data["steps"]))
        self.assertTrue(glb.exists())
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["m.glb", "r.json"])

    def test_edited_veins_are_given_back(self):
        leaf = ["grape", "--vertices", 400]
        run = [*leaf, "--iterations", 4, "--frames", 2]
        veins, plain, same, edited = (self.dir / name for name in ("veins.json", "plain.glb", "same.glb", "edited.glb"))
        self.expect(0, "veins", *leaf, "-o", veins)
        self.expect(0, "simulate", *run, "-o", plain)
        self.expect(0, "simulate", *run, "--veins", veins, "-o", same)
        self.assertEqual(same.read_bytes(), plain.read_bytes())
        document = json.loads(veins.read_text())
        del document["veins"][0]
        veins.write_text(json.dumps(document))
        self.expect(0, "simulate", *run, "--veins", veins, "-o", edited)
        self.assertNotEqual(edited.read_bytes(), plain.read_bytes())
        again = json.loads(self.expect(0, "veins", *leaf, "--veins", veins, "--json").stdout)
        self.assertEqual([v["positions"] for v in again["veins"]], [v["positions"] for v in document["veins"]])
        self.expect(3, "veins", "grape", "--vertices", 500, "--veins", veins, "-o", veins, says="another leaf's veins")

    def test_info_tells_what_a_result_holds(self):
        glb = self.dir / "m.glb"
        self.expect(0, "simulate", "tilia", "--vertices", 400, "--iterations", 4, "--frames", 3, "-o", glb)
        info = json.loads(self.expect(0, "info", glb, "--json").stdout)
        self.assertEqual(info["iterations"], [0, 2, 4])
        self.assertEqual([m["name"] for m in info["meshes"]], ["blade", "stalk"])
        self.assertEqual(info["config"]["species"], "tilia")

    def test_demo_leaves_pictures_and_a_leaf(self):
        result = self.expect(0, "demo", "-o", self.dir / "demo", "-q")
        self.assertIn("wilt simulate", result.stdout)
        self.assertEqual(sorted(os.listdir(self.dir / "demo")), ["maple.glb", "maple.png", "report.json", "stages.png"])
        self.assertEqual((self.dir / "demo" / "maple.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main()
