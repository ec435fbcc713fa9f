"""Blender's own Mesh Cache modifier on the OBJ and the point caches of a sample: at every frame the blade is where the
data beside them says.

The steps are those of point_cache.hpp: the OBJ imported as it is, the modifier's axes left alone. Starts Blender, in
which it runs itself again. Usage: play_caches.py SAMPLE ...   Exit code 77 (skipped) when Blender is not installed.
"""
import json
import pathlib
import shutil
import subprocess
import sys

try:
    import bpy
except ImportError:  # not within Blender yet
    if not shutil.which("blender"):
        print("skipped: Blender is not installed")
        sys.exit(77)
    command = ["blender", "--background", "--factory-startup", "--python", __file__, "--", *sys.argv[1:]]
    output = subprocess.run(command, capture_output=True, text=True, timeout=600)
    print(output.stdout, output.stderr)
    sys.exit(0 if f"{len(sys.argv) - 1} samples were played" in output.stdout else 1)

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.dont_write_bytecode = True
from check_glb import EPS, placed  # noqa: E402
from readers import pc2  # noqa: E402

FRAME_RATE = 24


def blade_at(blade, frame):
    bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))
    shown = blade.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array([vertex.co for vertex in shown.data.vertices])


def play(blade, path, expected):
    """The largest error over {scene frame: positions}."""
    modifier = blade.modifiers.new("withering", "MESH_CACHE")
    modifier.filepath = path
    modifier.cache_format = "PC2" if path.endswith("pc2") else "MDD"
    if modifier.cache_format == "MDD":
        modifier.time_mode = "TIME"
    else:  # it counts in samples
        modifier.frame_scale = 1 / pc2(path)[1]
    error = max(np.abs(blade_at(blade, frame) - positions).max() for frame, positions in expected.items())
    blade.modifiers.remove(modifier)
    return error


def check(stem):
    dump = json.load(open(stem + ".json"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = FRAME_RATE
    bpy.ops.wm.obj_import(filepath=stem + ".obj")
    blade = bpy.data.objects["blade"]
    frames = [placed(dump, frame["positions"]) for frame in dump["frames"]]
    scale = np.abs(frames).max()
    iterations = np.array([frame["iteration"] for frame in dump["frames"]])
    times = FRAME_RATE * dump["seconds"] * iterations / iterations[-1]
    error = play(blade, stem + ".mdd", dict(zip(times, frames)))
    even = np.linspace(0, times[-1], len(frames))
    stacked = np.stack(frames).reshape(len(frames), -1)
    samples = np.stack([np.interp(even, times, column) for column in stacked.T], axis=1).reshape(len(frames), -1, 3)
    errors = {"MDD": error, "PC2": play(blade, stem + ".pc2", dict(zip(even, samples)))}
    # Float32 positions that are blended, and a time in float32, between frames that differ by a tenth of the size.
    for name, error in errors.items():
        print(f"{pathlib.Path(stem).name}: {name:10} Blender {bpy.app.version_string} {len(frames)} frames, largest "
              f"error of a position {error:.1e} of {scale:.3g}")
        assert error <= 4 * EPS * scale, error


names = sys.argv[sys.argv.index("--") + 1 :]
for name in names:
    check(name)
print(f"{len(names)} samples were played")
