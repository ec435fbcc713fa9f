"""Blender's cloth on the workload's mesh: the time of a step, for `blender -b --factory-startup -P peer_blender.py --
WRITE_WORKLOAD VERTICES STIFFNESS NAME`; prints Google Benchmark's JSON.

A frame is one unit of the solver's time, so ten substeps a frame give the workload's dt = 0.1 (backward Euler, one linear
solve a substep). Blender divides the tension by the mean edge. Rest lengths stay: the drive would be a shape key a frame.
Time is that of a frame, its overhead included.
"""
import json
import statistics
import subprocess
import sys
import time

import bpy

FRAMES, SUBSTEPS = 12, 10
GRAVITY, DAMPING, PETIOLE_END = 0.002, 0.1, 0.03


def workload(program, vertices):
    text = subprocess.run([program, "mesh", vertices], check=True, capture_output=True, text=True).stdout
    rows = [line.split() for line in text.splitlines()]
    points = [tuple(map(float, row[1:])) for row in rows if row[0] == "v"]
    faces = [tuple(int(index) - 1 for index in row[1:]) for row in rows if row[0] == "f"]
    return points, faces


def add_leaf(points, faces, stiffness):
    mesh = bpy.data.meshes.new("leaf")
    mesh.from_pydata(points, [], faces)
    leaf = bpy.data.objects.new("leaf", mesh)
    bpy.context.scene.collection.objects.link(leaf)
    held = leaf.vertex_groups.new(name="held")
    held.add([i for i, p in enumerate(points) if p[0] < PETIOLE_END], 1.0, "ADD")
    cloth = leaf.modifiers.new("cloth", "CLOTH")
    edge = statistics.fmean((mesh.vertices[a].co - mesh.vertices[b].co).length for a, b in (e.vertices for e in mesh.edges))
    settings = cloth.settings
    settings.quality, settings.mass, settings.bending_model = SUBSTEPS, 1.1, "ANGULAR"
    settings.tension_stiffness = settings.compression_stiffness = stiffness * edge
    settings.tension_damping = settings.compression_damping = DAMPING
    settings.shear_stiffness = settings.bending_stiffness = settings.shear_damping = settings.bending_damping = 0.0
    settings.air_damping = 0.0
    settings.vertex_group_mass = "held"
    cloth.collision_settings.use_collision = cloth.collision_settings.use_self_collision = False
    cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, FRAMES + 2
    return len(mesh.edges)


def main():
    program, vertices, stiffness, name = sys.argv[sys.argv.index("--") + 1 :][:4]
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    scene = bpy.context.scene
    scene.gravity = (0.0, 0.0, -GRAVITY)
    springs = add_leaf(*workload(program, vertices), float(stiffness))
    scene.frame_set(1)
    times = []
    for frame in range(2, FRAMES + 2):
        begin = time.perf_counter()
        scene.frame_set(frame)
        times.append((time.perf_counter() - begin) / SUBSTEPS)
    print(json.dumps({"benchmarks": [{"name": name, "real_time": 1e3 * statistics.median(times[2:]), "time_unit": "ms",
                                      "springs": springs}]}), flush=True)


main()
