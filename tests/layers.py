"""Checks that every room includes only the rooms that src/wilt/layers.txt allows.

Also checks that no third-party header but Eigen's stands in a public header, and that no room includes a header which says
that it is for "inside the ... room only".
Usage: layers.py SOURCE_DIR
"""
import pathlib
import re
import sys

STANDARD = re.compile(r"^[a-z_]+$")


def read_layers(path):
    layers = {}
    for line in path.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            room, _, allowed = line.partition(":")
            layers[room.strip()] = set(allowed.split())
    return layers


def is_private(path):
    """Whether a header's opening comment says that it is for its own room only."""
    text = path.read_text()
    return "room only" in " ".join(text[: text.index("#pragma once")].replace("//", " ").split())


def faults_of(root):
    layers = read_layers(root / "src/wilt/layers.txt")
    for room_dir in sorted(p for p in (root / "src/wilt").iterdir() if p.is_dir()):
        room = room_dir.name
        if room not in layers:
            yield f"{room_dir}: the room is missing in src/wilt/layers.txt"
            continue
        for path in sorted(room_dir.glob("*.[hc]pp")):
            for number, line in enumerate(path.read_text().splitlines(), 1):
                include = re.match(r'\s*#include\s+[<"]([^>"]+)[>"]', line)
                if not include:
                    continue
                header = include.group(1)
                where = f"{path.relative_to(root)}:{number}"
                if header.startswith("wilt/"):
                    other = header.split("/")[1]
                    if other != room and is_private(root / "src" / header):
                        yield f"{where}: <{header}> is for the room {other} only"
                    if other != room and other not in layers[room]:
                        yield f"{where}: {room} must not include {other} (allowed: {' '.join(sorted(layers[room]))})"
                elif path.suffix == ".hpp" and not is_private(path) and not STANDARD.match(header) and not header.startswith("Eigen/"):
                    yield f"{where}: <{header}> in a public header; only Eigen's and the standard library's may stand there"


def main():
    root = pathlib.Path(sys.argv[1])
    faults = list(faults_of(root))
    print("\n".join(faults) or "layers: every include is allowed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
