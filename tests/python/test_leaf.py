"""Leaves and veins in Python.

Oracles: the program's veins.json; NumPy's own sums over faces; a drawn ellipse; the leaf that an array or file was made of.
"""
import json
import unittest

import cv2
import numpy as np

import wilt
from program import WithFolder


def file_axes(points):
    """Leaf frame (Z up) to files (Y up)."""
    return np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1)


def write_obj(path, positions, faces):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in file_axes(positions).tolist()]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in faces.tolist()]
    path.write_text("\n".join(lines) + "\n")


class Species(unittest.TestCase):
    def test_all_six_are_there_with_the_parameters_of_the_table(self):
        self.assertEqual(list(wilt.species()), ["maple", "poplar", "tilia", "ivy", "willow", "grape"])
        willow = wilt.species()["willow"]  # Table 1 of the paper
        self.assertEqual((willow.mass_min, willow.mass_max, willow.leaf_parameter, willow.dehydration_rate, willow.force_range),
                         (0.75, 1.55, 5e-3, 0.025, 0.8))

    def test_settings_have_default_unit_help_and_range(self):
        humidity = wilt.settings()["water.humidity"]
        self.assertEqual((humidity["default"], humidity["range"]), (0.5, (0.0, 1.0)))
        self.assertEqual(wilt.settings()["model"]["words"], ["paper", "cell"])
        self.assertEqual(wilt.settings("willow")["water.loss_rate"]["default"], 0.025)


class Leaves(WithFolder):
    def test_a_species_is_the_programs(self):
        leaf = wilt.Leaf.from_species("ivy", vertices=500, seed=3)
        self.program("veins", "ivy", "--vertices", 500, "--seed", 3, "-o", "veins.json")
        theirs = json.loads((self.dir / "veins.json").read_text())
        self.assertEqual((len(leaf.positions), len(leaf.faces)), (theirs["leaf"]["vertices"], theirs["leaf"]["faces"]))
        self.assertEqual(leaf.petiole, theirs["petiole"]["vertex"])
        self.assertAlmostEqual(leaf.length, theirs["leaf"]["length"], delta=1e-8)
        self.assertEqual(leaf.length, np.linalg.norm(leaf.positions - leaf.positions[leaf.petiole], axis=1).max())
        self.assertEqual((leaf.name, leaf.species, leaf.seed), ("ivy", "ivy", 3))
        veins = leaf.veins()
        self.assertEqual(veins.tips.tolist(), [tip["vertex"] for tip in theirs["tips"]])
        np.testing.assert_allclose(veins.s, theirs["margin"]["s"], atol=1e-8)
        np.testing.assert_allclose(veins.d, theirs["margin"]["d"], atol=1e-8)
        np.testing.assert_allclose(veins.tip_prominence, [tip["prominence"] for tip in theirs["tips"]], atol=1e-8)
        self.assertEqual(len(veins.veins), len(theirs["veins"]))
        for mine, their in zip(veins.veins, theirs["veins"]):
            self.assertEqual(mine.order, their["order"])
            np.testing.assert_allclose(file_axes(mine.positions), their["positions"], atol=1e-8)
            walked = np.linalg.norm(np.diff(mine.positions, axis=0), axis=1).sum()
            self.assertAlmostEqual(mine.length, walked, delta=1e-9 * walked)
        self.assertEqual(veins.vein_distance[veins.tips].max(), 0.0)

    def test_the_boundary_is_made_of_the_edges_with_one_face(self):
        leaf = wilt.Leaf.from_species("maple", vertices=400)
        edges = {}
        for a, b, c in leaf.faces.tolist():
            for edge in ((a, b), (b, c), (c, a)):
                edges[tuple(sorted(edge))] = edges.get(tuple(sorted(edge)), 0) + 1
        loop = leaf.boundary.tolist()
        self.assertEqual({tuple(sorted(edge)) for edge in zip(loop, loop[1:] + loop[:1])},
                         {edge for edge, count in edges.items() if count == 1})
        self.assertEqual([loop], [other.tolist() for other in leaf.boundary_loops])
        self.assertIn(leaf.petiole, loop)

    def test_normals_are_the_sums_of_the_faces_around(self):
        leaf = wilt.Leaf.from_species("tilia", vertices=400)
        corners = leaf.positions[leaf.faces]
        cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        sums = np.zeros_like(leaf.positions)
        for k in range(3):
            np.add.at(sums, leaf.faces[:, k], cross)
        np.testing.assert_allclose(leaf.normals, sums / np.linalg.norm(sums, axis=1, keepdims=True), atol=1e-12)
        self.assertGreater(leaf.normals[:, 2].min(), 0.0)

    def test_a_file_and_arrays_give_the_same_leaf(self):
        grown = wilt.Leaf.from_species("poplar", vertices=400)
        write_obj(self.dir / "mine.obj", grown.positions, grown.faces)
        x, y, z = file_axes(grown.positions)[grown.petiole]
        read = wilt.Leaf.from_file(self.dir / "mine.obj", petiole=(x, z))
        given = wilt.Leaf.from_arrays(grown.positions, grown.faces, petiole=grown.petiole, name="mine")
        for leaf in (read, given):
            self.assertEqual((leaf.name, leaf.species), ("mine", "generic"))
            self.assertTrue(any("no texture coordinates" in note for note in leaf.notes), leaf.notes)
        # The leaf frame stands on the mean normal, as that of a grown one need not: lengths are compared.
        lengths, read_lengths, given_lengths = (np.linalg.norm(leaf.positions, axis=1) for leaf in (grown, read, given))
        np.testing.assert_allclose(given_lengths, lengths, atol=1e-15)
        self.assertEqual((given.petiole, given.faces.tolist()), (grown.petiole, grown.faces.tolist()))
        # A mesh file holds single precision; its reader numbers the vertices in the order of the faces.
        np.testing.assert_allclose(np.sort(read_lengths), np.sort(lengths), atol=1e-7)
        self.assertEqual(len(read.faces), len(grown.faces))
        self.assertEqual(len(wilt.Leaf.from_file(str(self.dir / "mine.obj"), vertices=900).notes), len(read.notes) + 1)

    def test_arrays_of_other_kinds_are_taken_and_what_is_none_is_refused(self):
        leaf = wilt.Leaf.from_species("poplar", vertices=300)
        same = wilt.Leaf.from_arrays(leaf.positions.astype(np.float32).tolist(), leaf.faces.astype(np.int64).tolist(),
                                     uv=leaf.uv, petiole=leaf.petiole)
        np.testing.assert_allclose(same.uv, leaf.uv)
        for arguments, words in (((leaf.positions[:, :2], leaf.faces), "positions must be an array of N x 3, not of"),
                                 ((leaf.positions, leaf.faces + 1), "but there are"),
                                 ((leaf.positions, leaf.faces.astype(np.int64) + 2**40), "which there is not"),
                                 ((leaf.positions * np.nan, leaf.faces), "finite"),
                                 ((leaf.positions, leaf.faces, leaf.uv[:5]), "5 texture coordinates")):
            with self.assertRaisesRegex(ValueError, words):
                wilt.Leaf.from_arrays(*arguments)
        with self.assertRaises(TypeError):
            wilt.Leaf.from_arrays(leaf.positions, leaf.faces.astype(float))

    def test_a_photo_has_the_size_of_what_is_drawn(self):
        picture = np.full((600, 800, 3), 255, np.uint8)
        cv2.ellipse(picture, (400, 300), (250, 120), 0, 0, 360, (40, 140, 60), -1, cv2.LINE_AA)
        cv2.imwrite(str(self.dir / "leaf.png"), picture)
        leaf = wilt.Leaf.from_photo(self.dir / "leaf.png", mm_per_pixel=0.2, petiole=(150, 300), vertices=600)
        self.assertAlmostEqual(leaf.length, 500 * 0.2e-3, delta=0.01 * 0.1)
        self.assertEqual(wilt.count_leaves(self.dir / "leaf.png"), 1)
        write_obj(self.dir / "no.obj", leaf.positions, leaf.faces)
        with self.assertRaisesRegex(ValueError, "'no.obj' is no photo; take Leaf.from_file"):
            wilt.Leaf.from_photo(self.dir / "no.obj")


class Veins(WithFolder):
    def test_options_are_the_settings(self):
        leaf = wilt.Leaf.from_species("grape", vertices=600)
        few = leaf.veins(min_prominence=0.3, secondary=False)
        self.assertLess(len(few.tips), len(leaf.veins().tips))
        self.assertEqual({vein.order for vein in few.veins}, {1})
        self.assertEqual({v.order for v in wilt.Simulation(leaf, veins__secondary=False).veins.veins}, {1})
        with self.assertRaisesRegex(ValueError, "unknown setting 'veins.prominence'"):
            leaf.veins(prominence=1)

    def test_they_are_written_and_read_as_the_program_does(self):
        leaf = wilt.Leaf.from_species("maple", vertices=500)
        veins = leaf.veins()
        self.program("veins", "maple", "--vertices", 500, "-o", "p.json", "-o", "p.svg", "-o", "p.obj")
        for extension in ("json", "svg", "obj"):
            veins.save(self.dir / f"m.{extension}")
            self.assertEqual((self.dir / f"m.{extension}").read_bytes(), (self.dir / f"p.{extension}").read_bytes())
        edited = json.loads((self.dir / "m.json").read_text())
        edited["veins"] = [vein for vein in edited["veins"] if vein["order"] == 1][1:]
        (self.dir / "m.json").write_text(json.dumps(edited))
        drawn = leaf.veins(file=self.dir / "m.json")
        self.assertEqual(len(drawn.tips), len(veins.tips) - 1)
        with self.assertRaisesRegex(ValueError, "veins are .json, .svg or .obj"):
            veins.save("veins.txt")


if __name__ == "__main__":
    unittest.main()
