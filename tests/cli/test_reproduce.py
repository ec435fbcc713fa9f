"""wilt reproduce as a user meets it: a report whose links lead somewhere, numbers that can be read, plain refusals.

Oracles: an XML parser, the file system, a CSV reader, the contract of the exit codes.
"""
import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

WILT = sys.argv.pop(1)
XHTML = "{http://www.w3.org/1999/xhtml}"
SMALL = ["--vertices", "300", "--size", "64x48", "--samples", "1"]


def wilt(*arguments, **options):
    return subprocess.run([WILT, *map(str, arguments)], capture_output=True, text=True, timeout=600, **options)


class Reproduce(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name) / "a report"

    def tearDown(self):
        self.folder.cleanup()

    def expect(self, code, *arguments, says="", **options):
        result = wilt("reproduce", *arguments, **options)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertIn(says, result.stderr)
        return result

    def test_the_report_is_well_formed_and_its_links_lead_somewhere(self):
        result = self.expect(0, "table1", "table2", "fig2", "fig5", "fig10", "-o", self.dir, *SMALL, says="claims come out")
        self.assertIn("index.html", result.stderr)
        page = ElementTree.parse(self.dir / "index.html").getroot()
        ids = [e.get("id") for e in page.iter() if e.get("id")]
        self.assertEqual(len(ids), len(set(ids)))
        links = [e.get("href") for e in page.iter(XHTML + "a")] + [e.get("src") for e in page.iter(XHTML + "img")]
        self.assertGreater(len(links), 10)
        linked = {"index.html"}
        for link in links:
            if link.startswith("#"):
                self.assertIn(link[1:], ids)
            else:
                self.assertNotIn("/", link)
                linked.add(link)
        self.assertEqual(linked, {p.name for p in self.dir.iterdir()})
        for image in page.iter(XHTML + "img"):
            self.assertTrue(image.get("alt"))
        self.assertFalse(list(page.iter(XHTML + "script")))
        for svg in self.dir.glob("*.svg"):
            ElementTree.parse(svg)
        text = "".join(page.itertext())
        for row in csv.DictReader((self.dir / "claims.csv").read_text().splitlines()):
            self.assertIn(row["reason"], text)
        self.assertNotIn(str(self.dir), (self.dir / "index.html").read_text())

    def test_json_on_stdout_is_claims_csv(self):
        result = self.expect(0, "table1", "fig2", "-o", self.dir, "--json", "-q", *SMALL)
        self.assertEqual(result.stderr, "")
        claims = json.loads(result.stdout)
        rows = list(csv.DictReader((self.dir / "claims.csv").read_text().splitlines()))
        self.assertEqual([(c["figure"], c["id"], c["model"], c["verdict"]) for c in claims],
                         [(r["figure"], r["id"], r["model"], r["verdict"]) for r in rows])
        self.assertEqual([c["value"] for c in claims], [float(r["value"]) for r in rows])

    def test_wrong_command_lines_exit_2(self):
        self.expect(2, "fig77", "-o", self.dir, says="did you mean 'fig7'?")
        self.expect(2, "table1", "-o", self.dir, "--size", "big", says="WxH")
        self.expect(2, "table1", "-o", self.dir, "--vertices", "10", says="200 to 1000000")
        self.assertFalse(self.dir.exists())

    def test_what_cannot_be_written_or_drawn_exits_5_before_the_work(self):
        blocked = pathlib.Path(self.folder.name) / "file"
        blocked.write_text("here")
        self.expect(5, "all", "-o", blocked, says=str(blocked))
        self.assertEqual(blocked.read_text(), "here")
        empty = pathlib.Path(self.folder.name) / "empty"
        empty.mkdir()
        self.expect(5, "all", "-o", self.dir, says="gnuplot-nox", env={**os.environ, "PATH": str(empty)})
        self.assertFalse(self.dir.exists())

    def test_interrupting_keeps_the_figures_that_are_done_and_exits_130(self):
        process = subprocess.Popen([WILT, "reproduce", "fig2", "fig8", "-o", str(self.dir), "--vertices", "1500"],
                                   stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not (self.dir / "fig2-expansion.svg").exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 130, messages)
        page = (self.dir / "index.html").read_text()
        self.assertIn("fig2-expansion.svg", page)
        self.assertNotIn('id="fig8"', page)


if __name__ == "__main__":
    unittest.main()
