"""One leaf for Blender: a species or your own photo, withered, as a clip that plays.

    python3 examples/python/animator.py [LEAF] [DIRECTORY]
"""
# %% Which leaf: a species, a photo on a plain background, a drawing (.svg) or a mesh.
import pathlib
import sys

import wilt

source = sys.argv[1] if len(sys.argv) > 1 else "grape"
folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "out/animator")
folder.mkdir(parents=True, exist_ok=True)

leaf = wilt.Leaf.from_species(source, vertices=4000) if source in wilt.species() else wilt.Leaf.from_file(source)
print(leaf, *leaf.notes, sep="\n  ")

# %% Wither it: a warm, dry room; 61 frames over five seconds.
simulation = wilt.Simulation(leaf, frames=61, clip__seconds=5.0, water__humidity=0.3, water__temperature_c=28)
simulation.run(lambda now: print(f"\riteration {now.iteration} of {now.last_iteration}", end="", flush=True))
print()
result = simulation.result

# %% The clip, and a look at it before Blender is opened.
clip = (folder / f"{leaf.name}.glb").resolve()
result.save(clip, folder / f"{leaf.name}.png")
last = result.frames[-1].metrics
print(f"curl {last.curl:.2f} rad, area {100 * last.area_ratio:.0f} %, in {clip}")

# %% In Blender: with the add-on of integrations/blender (docs/pipelines/blender.md), which also plays the colours ...
importer = pathlib.Path(__file__).resolve().parents[2] / "integrations" / "blender" / "wilt_import.py"
print(f"\nwithout a window:\n  blender --background --python {importer} -- {clip} --save {clip.with_suffix('.blend')}")
# ... or with what Blender has of its own (shapes only), in its Python console:
print(f"""in Blender's Python console:
  import bpy, numpy; numpy.bool = bool
  bpy.ops.import_scene.gltf(filepath={str(clip)!r})
  bpy.ops.screen.animation_play()""")
