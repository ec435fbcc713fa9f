"""Inside Blender: what a saved scene shows at given frames. blender FILE.blend --background --python THIS -- OUT.npz FRAME ..."""
import sys

import bpy
import numpy as np

out, *frames = sys.argv[sys.argv.index("--") + 1 :]
scene, arrays = bpy.context.scene, {}
arrays["range"] = [scene.frame_start, scene.frame_end, scene.render.fps]
for number, frame in enumerate(map(float, frames)):
    scene.frame_set(int(frame), subframe=frame - int(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    for leaf in scene.objects:
        shown = leaf.evaluated_get(graph)
        points = np.empty((len(shown.data.vertices), 3), np.float32)
        shown.data.vertices.foreach_get("co", points.ravel())
        colours = np.empty((len(points), 4), np.float32)
        shown.data.attributes["wilt_colour"].data.foreach_get("color", colours.ravel())
        arrays[f"{leaf.name} positions {number}"] = points @ np.array(shown.matrix_world.to_3x3(), np.float32).T
        arrays[f"{leaf.name} colours {number}"] = colours[:, :3]
np.savez(out, **arrays)
