"""The manual, the completions, --dry-run and --print-config: all made from the command line's own definitions.

Oracles: mandoc and groff (their warnings), bash, zsh and fish themselves, --help's own list of options, JSON and TOML
parsers, listings of folders before and after. Seen to fail: --dry-run that
forgot an OBJ's material and maps.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

WILT = sys.argv.pop(1)
VERBS = ["demo", "species", "leaf", "veins", "simulate", "render", "info", "reproduce", "view"]
SPECIES = ["maple", "poplar", "tilia", "ivy", "willow", "grape"]
# What stands on the screen of a zsh in which LINE and a tab were typed.
ZSH = r"""
zmodload zsh/zpty
zpty -b shell "TERM=dumb zsh -f -i"
zpty -w shell "PROMPT=; fpath=(FOLDER \$fpath); autoload -U compinit; compinit -u -d FOLDER/dump; bindkey '^I' complete-word
LISTMAX=10000; print 'REA''DY'"
integer n=0
while (( n++ < 1200 )); do
  if zpty -r -t shell line; then [[ $line == *READY* ]] && break; else sleep 0.05; fi
done
zpty -w -n shell "LINE"$'\t'
n=0
while (( n++ < 40 )); do
  if zpty -r -t shell line; then print -r -- $line; n=0; else sleep 0.05; fi
done
zpty -d shell
"""


def wilt(*arguments, code=0, **options):
    result = subprocess.run([WILT, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options)
    assert result.returncode == code, result.stderr
    return result


def flags_in_help(verb):
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", "\n".join(
        line[:34] for line in wilt(verb, "--help").stdout.split("Options:")[1].splitlines() if line.startswith("  -"))))


class Scratch(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="wilt-terminal-")
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()


class Manual(Scratch):
    def test_every_option_stands_in_it_with_a_description(self):
        page = wilt("--man").stdout
        for verb in VERBS:
            section = page.split(f".SS wilt {verb}\n")[1].split("\n.S")[0].replace("\\-", "-")
            for flag in flags_in_help(verb):
                self.assertIn(f"\\fB{flag}\\fR", section, verb)
        entries = re.findall(r"^\.TP\n(.*)\n(.*)$", page, re.MULTILINE)
        self.assertGreater(len(entries), 100)
        for name, text in entries:
            self.assertRegex(text, r"^\S.{6}", name)
        self.assertIn("water.humidity", page)
        for code in (0, 2, 3, 4, 5, 130):
            self.assertIn(f".B {code}\n", page.split(".SH EXIT STATUS")[1])
        self.assertIn(".SH FILES", page)

    def test_readers_of_manuals_find_nothing_wrong(self):
        page = self.dir / "wilt.1"
        page.write_text(wilt("--man").stdout)
        checks = {"groff": ["groff", "-man", "-ww", "-Tutf8"], "mandoc": ["mandoc", "-Tlint", "-Wwarning"]}
        found = {name: command for name, command in checks.items() if shutil.which(name)}
        if not found:
            self.skipTest("neither groff nor mandoc is there")
        for name, command in found.items():
            done = subprocess.run([*command, page], capture_output=True, text=True)
            said = [line for line in (done.stderr if name == "groff" else done.stdout).splitlines()
                    if "missing date" not in line]  # a date would be another in every build
            self.assertEqual(said, [], name)


class Completions(Scratch):
    def complete(self, shell, *words):
        script = self.dir / f"wilt.{shell}"
        script.write_text(wilt("--completion", shell).stdout)
        command = {
            "bash": ["bash", "-c", 'source "$0"; compopt() { :; }; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _wilt; '
                     'printf "%s\n" "${COMPREPLY[@]}"', script, "wilt", *words],
            "fish": ["fish", "--no-config", "-c", f"source {script}; complete -C 'wilt {' '.join(words)}'"],
        }[shell]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, cwd=self.dir,
                              env={**os.environ, "HOME": str(self.dir), "TERM": "dumb"})
        lines = [line.rstrip() for line in done.stdout.splitlines()]
        return sorted({line.split("\t")[0].split(":")[0] if shell != "bash" else line for line in lines if line})

    def screen_of_zsh(self, *words):
        (self.dir / "_wilt").write_text(wilt("--completion", "zsh").stdout)
        script = ZSH.replace("FOLDER", str(self.dir)).replace("LINE", "wilt " + " ".join(words))
        done = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, timeout=300, cwd=self.dir,
                              env={**os.environ, "HOME": str(self.dir)})
        return done.stdout.replace("\r", "").replace("\n", "")

    def check(self, shell):
        if not shutil.which(shell):
            self.skipTest(f"{shell} is not there")
        for name in ("drawing.svg", "maple photo.jpg"):
            (self.dir / name).touch()
        (self.dir / "folder").mkdir()

        def offers(words, *expected, exactly=False):
            found = self.complete(shell, *words)
            with self.subTest(shell=shell, words=words):
                if exactly:
                    self.assertEqual(found, sorted(expected))
                self.assertLessEqual(set(expected), set(found), found)
            return found

        offers(["sim"], "simulate", exactly=True)
        offers([""], *VERBS)
        found = offers(["simulate", "ma"], "maple")
        self.assertTrue(any("photo" in word for word in found), found)
        offers(["simulate", "--mod"], "--model", exactly=True)
        offers(["simulate", "--model", ""], "cell", "paper", exactly=True)
        offers(["render", "x.glb", "-o", "dr"], "drawing.svg")
        offers(["simulate", "maple", "--set", "water.h"], "water.humidity=", exactly=True)
        offers(["simulate", "--vat", "p"], "png", exactly=True)
        offers(["--color", "n"], "never", exactly=True)
        offers(["leaf", "--col"], "--color", exactly=True)
        self.assertNotIn("drawing.svg", offers(["demo", "-o", ""]))
        offers(["reproduce", "fig1"], "fig10", "fig11", "fig12", "fig13", "fig14", "fig15", exactly=True)

    def test_bash(self):
        self.check("bash")
        self.assertEqual(self.complete("bash", "simulate", "--model", "=", "p"), ["paper"])
        for verb in VERBS:
            self.assertEqual(set(self.complete("bash", verb, "-")) & flags_in_help(verb), flags_in_help(verb))

    def test_zsh(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not there")
        (self.dir / "drawing.svg").touch()
        for words, expected in ((["sim"], ["wilt simulate "]), ([""], VERBS), (["simulate", "wil"], ["willow"]),
                                (["simulate", "--model", ""], ["cell", "paper"]),
                                (["render", "x.glb", "-o", "dr"], ["drawing.svg"]),
                                (["simulate", "maple", "--set", "water.h"], ["water.humidity="]),
                                (["leaf", "--col"], ["--color="])):
            screen = self.screen_of_zsh(*words)
            for word in expected:
                self.assertIn(word, screen, words)

    def test_fish(self):
        self.check("fish")

    def test_an_unknown_shell_is_refused(self):
        self.assertIn("takes one of bash, fish, zsh, not 'tcsh'", wilt("--completion", "tcsh", code=2).stderr)


class DryRun(Scratch):
    def setUp(self):
        super().setUp()
        self.result = self.dir / "result.glb"
        wilt("simulate", "ivy", "--vertices", 200, "--iterations", 2, "--frames", 3, "--set", "texture.size=16", "-o",
             self.result, "-q")

    def listing(self):
        return {str(p): p.read_bytes() for p in self.dir.rglob("*") if p.is_file()}

    def test_it_says_what_a_run_then_does(self):
        """Oracle: the run itself."""
        runs = [["simulate", "willow", "--vertices", 300, "--iterations", 3, "--frames", 2, "--set", "texture.size=16", "-o",
                 self.dir / "a.pvd", "-o", self.dir / "a.####.ply", "-o", self.dir / "a.pc2", "--forces", self.dir / "f.csv"],
                ["leaf", "ivy", "--vertices", 300, "-o", self.dir / "l.obj"],
                ["veins", "ivy", "--vertices", 300, "-o", self.dir / "v.svg", "-o", self.dir / "v.json"],
                ["render", self.result, "-o", self.dir / "p.png", "--size", "32x32", "--samples", 1]]
        for run in runs:
            before = self.listing()
            plan = json.loads(wilt(*run, "--dry-run", "--json").stdout)
            said = wilt(*run, "--dry-run").stdout
            self.assertEqual(self.listing(), before)
            files = {entry["file"] for entry in plan["files"]}
            self.assertFalse(any(entry["replaces"] for entry in plan["files"]))
            wilt(*run, "-q")
            made = set(self.listing()) - set(before)
            self.assertLessEqual(made, files)
            # A leaf's maps are written where it has a texture; the rest always is.
            self.assertTrue(all(".texture." in f or ".normal." in f for f in files - made), files - made)
            self.assertTrue(all(f"would write {file}\n" in said for file in files))
            self.assertTrue(all(e["replaces"] == (e["file"] in made)
                                for e in json.loads(wilt(*run, "--dry-run", "--json").stdout)["files"]))

    def test_it_is_quick_where_the_run_is_not(self):
        plan = json.loads(wilt("simulate", "maple", "--vertices", 1000000, "--iterations", 1000000, "-o", self.dir / "m.glb",
                               "--dry-run", "--json").stdout)
        self.assertEqual((plan["vertices"], plan["iterations"], plan["model"]), (1000000, 1000000, "cell"))

    def test_it_refuses_what_a_run_refuses(self):
        broken = self.dir / "broken.obj"
        broken.write_text("v 0 0 0\n")
        before = self.listing()
        for code, arguments in ((5, ["simulate", "maple", "-o", self.dir / "none" / "m.glb"]),
                                (3, ["simulate", broken, "-o", self.dir / "m.glb"]),
                                (2, ["simulate", "maple", "-o", self.dir / "m.glb", "--set", "dt=7"]),
                                (3, ["simulate", "maple", "-o", self.dir / "m.glb", "--veins", self.dir / "none.json"]),
                                (2, ["leaf", "maple"]), (5, ["veins", "ivy", "-o", self.dir / "none" / "v.svg"]),
                                (3, ["render", broken, "-o", self.dir / "p.png"]),
                                (2, ["render", self.result, "-o", self.dir / "p.png", "--frame", 3])):
            self.assertTrue(wilt(*arguments, "--dry-run", code=code).stderr.startswith("error: "))
        self.assertEqual(self.listing(), before)


class Settings(unittest.TestCase):
    def test_print_config_lists_unit_default_and_range(self):
        text = wilt("simulate", "ivy", "--set", "water.humidity=0.25", "--print-config").stdout
        table = {row["key"]: row for row in json.loads(
            wilt("simulate", "ivy", "--set", "water.humidity=0.25", "--print-config", "--json").stdout)}
        flat = {}
        for key, value in tomllib.loads(text).items():
            flat |= {f"{key}.{k}": v for k, v in value.items()} if isinstance(value, dict) else {key: value}
        self.assertEqual(flat, {key: row["value"] for key, row in table.items()})
        self.assertTrue(table["water.humidity"]["during_run"] and not table["dt"]["during_run"])
        row = table["water.humidity"]
        self.assertEqual((row["value"], row["default"], row["range"], row["unit"]), (0.25, 0.5, [0, 1], ""))
        self.assertIn("0 to 1; default 0.5", text)
        self.assertEqual(table["species"]["words"], ["generic"] + SPECIES if "generic" in table["species"]["words"] else SPECIES)
        for key, row in table.items():
            self.assertTrue(row["help"], key)
            self.assertTrue("range" in row or "words" in row, key)
            if row["value"] == row["default"] == []:  # a list
                continue
            allowed = row["range"] if "range" in row else row["words"]
            self.assertTrue(row["default"] in allowed or str(row["default"]).lower() in map(str, allowed)
                            or allowed[0] <= row["default"] <= allowed[1] or key == "species", key)


if __name__ == "__main__":
    unittest.main()
