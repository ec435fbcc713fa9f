"""Vertex-animation textures, read as a game engine would: from the JSON and the pictures alone, by OpenCV.

Oracle: the positions, normals and colours of every frame of the GLB of the same run, read by check_glb.py's reader; for the
coarser meshes, distances by brute force. Usage: test_animation_texture.py WILT FOLDER_OF_CHECK_GLB
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
WILT = sys.argv.pop(1)
sys.path.insert(0, sys.argv.pop(1))
try:
    import cv2
except ImportError:
    print("skipped: Python has no OpenCV (Debian: python3-opencv)")
    sys.exit(77)
import numpy as np
from check_glb import Glb


def run(*arguments):
    subprocess.run([WILT, "simulate", *map(str, arguments), "-q"], check=True, timeout=600)


def decode(path, track):
    picture = cv2.imread(str(path / track["file"]), cv2.IMREAD_UNCHANGED)
    texels = picture[:, :, ::-1].astype(np.float64)  # OpenCV's order is blue, green, red
    if picture.dtype == np.uint16:
        texels /= 65535
    low, high = np.array(track["min"]), np.array(track["max"])
    return low + texels * (high - low)


def texels_of(vat, picture, lookup, frame):
    """What a shader reads: the lookup of the mesh, moved down by the rows of the frames before."""
    height, width = picture.shape[:2]
    assert (height, width) == (vat["texture"]["height"], vat["texture"]["width"])
    for side in (height, width):
        assert side & (side - 1) == 0 and side <= 8192
    v = lookup[:, 1] + frame * vat["texture"]["rows_per_frame"] / height
    column, row = lookup[:, 0] * width - 0.5, v * height - 0.5
    np.testing.assert_allclose(column, np.round(column), atol=1e-3)  # the centre of a texel
    return picture[np.round(row).astype(int), np.round(column).astype(int)]


def meshes(path):
    glb = Glb(path)
    for mesh in glb.json["meshes"]:
        (primitive,) = mesh["primitives"]
        faces = glb.accessor(primitive["indices"]).reshape(-1, 3).astype(int)
        yield mesh["name"], glb, primitive, faces


def border(faces):
    """Vertices of edges that have one triangle."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    return np.unique(edges[count == 1])


def distance(p, a, b, c):
    """From a point to the nearest of many triangles: the sides, and the inside by barycentric coordinates."""
    def to_side(start, end):
        side = end - start
        t = np.clip(np.einsum("ij,ij->i", p - start, side) / np.einsum("ij,ij->i", side, side), 0, 1)
        return np.linalg.norm(start + t[:, None] * side - p, axis=1)

    nearest = np.minimum(np.minimum(to_side(a, b), to_side(b, c)), to_side(c, a)).min()
    normal = np.cross(b - a, c - a)
    area = np.einsum("ij,ij->i", normal, normal)
    u, v = (np.einsum("ij,ij->i", np.cross(q - p, r - p), normal) / area for q, r in ((b, c), (c, a)))
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    height = np.abs(np.einsum("ij,ij->i", p - a, normal)) / np.sqrt(area)
    return min(nearest, height[inside].min(initial=np.inf))


class AnimationTexture(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def check(self, bound, *arguments):
        """`bound(track, frame's values, what they are)`: how large an error may be."""
        run(*arguments, "-o", self.folder / "leaf.glb", "-o", self.folder / "leaf.vat.json")
        vat = json.loads((self.folder / "leaf.vat.json").read_text())
        pictures = {name: decode(self.folder, vat[name]) for name in ("positions", "normals", "colours")}
        rest = {name: (glb, primitive) for name, glb, primitive, _ in meshes(self.folder / "leaf.rest.glb")}
        for name, glb, primitive, _ in meshes(self.folder / "leaf.glb"):
            rest_glb, rest_primitive = rest[name]
            lookup = rest_glb.attribute(rest_primitive, "TEXCOORD_1")
            at_rest = rest_glb.attribute(rest_primitive, "POSITION")
            self.assertEqual(len(glb.frames(primitive, "POSITION")), vat["frames"])
            for frame in range(vat["frames"]):
                read = {track: texels_of(vat, picture, lookup, frame) for track, picture in pictures.items()}
                for track, key in (("positions", "POSITION"), ("normals", "NORMAL"), ("colours", "COLOR_0")):
                    expected = glb.frames(primitive, key)[frame] - (at_rest if track == "positions" else 0)
                    error = np.abs(read[track] - expected)
                    self.assertTrue(np.all(error <= bound(vat[track], expected)), (name, frame, track, error.max()))
        return vat

    def half_float(self, _, expected):
        """Half an ulp of a half float: 2^-11 of the value, 2^-25 where it is subnormal; and float32's of the GLB."""
        return np.maximum(np.abs(expected) * 2.0**-11, 2.0**-25) + 1e-7

    def sixteen_bits(self, track, _):
        return 0.5 / 65535 * (np.array(track["max"]) - np.array(track["min"])) + 1e-7

    def test_half_floats_hold_every_frame(self):
        vat = self.check(self.half_float, "maple", "--vertices", 400, "--iterations", 30, "--frames", 7)
        self.assertEqual(vat["frames"], 7)
        np.testing.assert_allclose(vat["fps"], 6 / vat["seconds"])

    def test_sixteen_bits_hold_every_frame(self):
        self.check(self.sixteen_bits, "grape", "--vertices", 400, "--iterations", 30, "--frames", 7, "--vat", "png")

    def test_frames_wrap_over_several_rows(self):
        vat = self.check(self.half_float, "poplar", "--vertices", 9000, "--iterations", 2, "--frames", 3, "--set",
                         "texture.size=0")
        self.assertEqual(vat["texture"]["rows_per_frame"], 2)

    def test_too_many_frames_are_refused_before_the_work(self):
        result = subprocess.run([WILT, "simulate", "maple", "--frames", "9000", "--iterations", "9000", "-o",
                                 str(self.folder / "leaf.vat.json")], capture_output=True, text=True, timeout=20)
        self.assertEqual(result.returncode, 2)
        self.assertIn("at most 8192", result.stderr)

    def test_coarser_meshes_stand_on_the_same_texels(self):
        run("maple", "--vertices", 500, "--iterations", 30, "--frames", 4, "--lods", 2, "-o", self.folder / "leaf.vat.json")
        vat = json.loads((self.folder / "leaf.vat.json").read_text())
        self.assertEqual(len(vat["levels"]), 3)
        positions = decode(self.folder, vat["positions"])

        def shapes(file):
            for name, glb, primitive, faces in meshes(self.folder / file):
                lookup, rest = (glb.attribute(primitive, key) for key in ("TEXCOORD_1", "POSITION"))
                yield name, faces, lookup, [rest + texels_of(vat, positions, lookup, k) for k in range(vat["frames"])]

        full = {name: rest for name, *rest in shapes("leaf.rest.glb")}
        before = np.inf
        for level in vat["levels"][1:]:
            triangles, worst = 0, 0.0
            for name, faces, lookup, frames in shapes(level["file"]):
                all_faces, all_lookup, all_frames = full[name]
                ids = {tuple(row): i for i, row in enumerate(all_lookup)}
                kept = [ids[tuple(row)] for row in lookup]  # a KeyError: no vertex of the full mesh
                if name == "blade":  # the stalk is closed
                    self.assertEqual(set(border(all_faces)), {kept[v] for v in border(faces)})
                for some, everyone in zip(frames, all_frames):
                    np.testing.assert_array_equal(some, everyone[kept])
                    a, b, c = (some[faces[:, i]] for i in range(3))
                    worst = max(worst, max(distance(p, a, b, c) for p in everyone))
                triangles += len(faces)
            self.assertEqual(triangles, level["triangles"])
            self.assertLess(triangles, before)
            before = triangles
            # Half floats move both sides by 2^-11 of offsets below 0.1 m.
            self.assertAlmostEqual(worst, level["deviation_m"], delta=2e-4)


if __name__ == "__main__":
    unittest.main()
