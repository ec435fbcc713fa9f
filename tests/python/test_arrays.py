"""Arrays are views where they can be, live as long as they are held, and never change under their holder.

Oracles: np.shares_memory, copies taken while the owner lived (freed memory is overwritten here: MALLOC_PERTURB_).
"""
import gc
import unittest

import numpy as np

import wilt

LEAF = ["positions", "faces", "uv", "uv_faces", "stalk", "stalk_radii"]
VEINS = ["s", "d", "flat", "primary_distance", "vein_distance"]
FRAME = ["positions", "stalk", "water_fraction", "dryness"]
STATE = FRAME + ["working_positions", "velocities", "water", "dry_mass", "mass", "pressure"]


def simulation():
    return wilt.Simulation(wilt.Leaf.from_species("willow", vertices=300), iterations=6, frames=3, texture__size=0)


class Views(unittest.TestCase):
    def check(self, make, names):
        """One memory for all who ask, not to be written, and whole when only the array is left."""
        for name in names:
            owner = make()
            array, again = getattr(owner, name), getattr(owner, name)
            self.assertTrue(np.shares_memory(array, again), name)
            self.assertFalse(array.flags.owndata, name)
            with self.assertRaises(ValueError, msg=name):
                array[...] = 0
            before = array.copy()
            del owner, again
            gc.collect()
            np.testing.assert_array_equal(array, before, name)

    def test_of_a_leaf(self):
        self.check(lambda: wilt.Leaf.from_species("willow", vertices=300), LEAF)

    def test_of_veins(self):
        self.check(lambda: wilt.Leaf.from_species("willow", vertices=300).veins(), VEINS)

    def test_of_frames(self):
        self.check(lambda: simulation().run().frames[-1], FRAME)

    def test_of_states(self):
        self.check(lambda: next(simulation()), STATE)

    def test_of_forces(self):
        sim = simulation()
        sim.step()
        forces = sim.state.forces
        self.assertEqual(list(forces), ["elastic", "damping", "swelling", "external"])
        before = {kind: force.copy() for kind, force in forces.items()}
        self.assertTrue(np.shares_memory(forces["elastic"], sim.state.forces["elastic"]))
        sim.run()
        del sim
        gc.collect()
        for kind, force in forces.items():
            np.testing.assert_array_equal(force, before[kind])

    def test_of_results_share_the_frames_memory(self):
        result = simulation().run()
        self.assertTrue(np.shares_memory(result.frames[1].positions, result.frames[1].positions))

    def test_shapes_and_types(self):
        sim = simulation()
        state = next(sim)
        count = len(sim.leaf.positions)
        for name in STATE:
            array = getattr(state, name)
            self.assertEqual(array.dtype, np.float64, name)
            self.assertTrue(array.flags.c_contiguous, name)
            if name != "stalk":
                self.assertIn(array.shape, {(count, 3), (count,)}, name)
        for array in (sim.leaf.faces, sim.leaf.uv_faces, sim.leaf.boundary, sim.veins.tips):
            self.assertEqual(array.dtype, np.int32)


class States(unittest.TestCase):
    def test_stay_when_the_simulation_goes_on(self):
        """Halved steps move the state elsewhere in memory; a state keeps its own."""
        sim = simulation()
        states = list(sim)
        self.assertEqual([state.iteration for state in states], [1, 2, 3, 4, 5, 6])
        kept = [state.velocities.copy() for state in states]
        again = simulation()
        for state, velocities in zip(states, kept):
            again.step()
            np.testing.assert_array_equal(again.state.velocities, velocities)
            np.testing.assert_array_equal(state.velocities, velocities)
        self.assertFalse(np.shares_memory(states[0].positions, states[1].positions))

    def test_hold_together(self):
        """Mass is water and dry matter; at rest in working units the leaf is 8 long; the droop is a rigid motion."""
        sim = simulation()
        rest = sim.state
        far = np.linalg.norm(rest.working_positions - rest.working_positions[sim.leaf.petiole], axis=1).max()
        self.assertAlmostEqual(far, 8.0, delta=1e-12)
        np.testing.assert_allclose(rest.positions, sim.leaf.positions, atol=1e-15)
        for state in sim:
            np.testing.assert_array_equal(state.mass, state.water + state.dry_mass)
            np.testing.assert_allclose(state.water_fraction, state.water / state.mass, rtol=1e-15)
            self.assertLess(state.pressure.max(), 0.0)
            edges = sim.leaf.faces[:, :2]
            metres = np.linalg.norm(np.diff(state.positions[edges], axis=1), axis=2)
            working = np.linalg.norm(np.diff(state.working_positions[edges], axis=1), axis=2)
            np.testing.assert_allclose(working, 8.0 / sim.leaf.length * metres, rtol=1e-9)

    def test_colours_are_those_of_the_species_fresh_and_dry(self):
        """Green at rest, less so as the leaf dries: the red over green grows on the mean."""
        sim = wilt.Simulation(wilt.Leaf.from_species("grape", vertices=300), iterations=60, frames=2)
        fresh, dry = (frame.colours for frame in sim.run().frames)
        self.assertEqual(fresh.shape, (len(sim.leaf.positions), 3))
        self.assertTrue((fresh.argmax(axis=1) == 1).mean() > 0.95)
        self.assertGreater((dry[:, 0] / dry[:, 1]).mean(), 1.2 * (fresh[:, 0] / fresh[:, 1]).mean())


if __name__ == "__main__":
    unittest.main()
