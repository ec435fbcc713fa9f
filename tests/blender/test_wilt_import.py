"""The Blender script, run without a window: shapes and colours of the saved scene at key frames and between them.

Oracle: the GLB's own data by check_glb.py's reader, linear between frames. Blender plays float32 weights and shapes: a few eps.
Usage: test_wilt_import.py SCRIPT FOLDER_OF_CHECK_GLB FILE.glb ...    Exit code 77 (skipped) without Blender.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np

script, reader, *files = sys.argv[1:]
if not shutil.which("blender"):
    print("skipped: Blender is not installed (Debian: blender)")
    sys.exit(77)
sys.path.insert(0, reader)
from check_glb import Glb

FPS = 24
HERE = pathlib.Path(__file__).parent
TOLERANCE = 8 * float(np.finfo(np.float32).eps)


def blender(*arguments):
    done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", *map(str, arguments)],
                          capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr


def check(path, folder):
    glb = Glb(path)
    times = [0.0]
    if "animations" in glb.json:
        times = glb.accessor(glb.json["animations"][0]["samplers"][0]["input"]).ravel()
    shown_at = sorted([*times, *((a + b) / 2 for a, b in zip(times, times[1:]))])
    scene, dump = folder / "leaf.blend", folder / "leaf.npz"
    blender("--python", script, "--", path, "--save", scene)
    blender(scene, "--python", HERE / "dump_scene.py", "--", dump, *(1 + FPS * t for t in shown_at))
    shown = np.load(dump)
    np.testing.assert_array_equal(shown["range"], [1, np.ceil(1 + FPS * times[-1] - 1e-3), FPS])
    metres = glb.json["asset"]["extras"]["wilt"]["metres_per_unit"]
    worst = 0.0
    for mesh in glb.json["meshes"]:
        (primitive,) = mesh["primitives"]
        for key, name in (("POSITION", "positions"), ("COLOR_0", "colours")):
            if key not in primitive["attributes"]:
                continue
            frames = np.array(glb.frames(primitive, key))
            if len(frames) == 1:
                frames = np.repeat(frames, len(times), axis=0)
            if key == "POSITION":
                frames = metres * np.stack([frames[..., 0], -frames[..., 2], frames[..., 1]], axis=-1)
            for number, time in enumerate(shown_at):
                after = min(int(np.searchsorted(times, time)), len(times) - 1)
                before = max(after - 1, 0)
                share = (time - times[before]) / (times[after] - times[before]) if after > before else 0.0
                expected = (1 - share) * frames[before] + share * frames[after]
                found = shown[f"{mesh['name']} {name} {number}"]
                assert found.shape == expected.shape, (found.shape, expected.shape)
                # Times are float32 too, and a frame's number is some hundred times larger than its share.
                error = np.abs(found - expected).max() / np.abs(frames).max()
                assert error < (TOLERANCE if time in times else 100 * TOLERANCE), (path, name, time, error)
                worst = max(worst, error)
    print(f"{path}: {len(shown_at)} times, largest relative error {worst:.2g}")


for file in files:
    with tempfile.TemporaryDirectory() as temporary:
        check(file, pathlib.Path(temporary))
refusal = subprocess.run(["blender", "--background", "--python", script, "--", __file__], capture_output=True, text=True)
assert "is no GLB" in refusal.stdout + refusal.stderr and refusal.returncode == 1, refusal
