"""Simulations in Python: steps, threads, Ctrl-C, checkpoints.

Oracles: the program's report.json and files; a run that was never left; signals that the system delivers.
"""
import json
import os
import signal
import threading
import unittest

import numpy as np

import wilt
from program import WithFolder

SMALL = {"iterations": 12, "frames": 4, "texture__size": 0}


def leaf(name="maple", **options):
    return wilt.Leaf.from_species(name, **{"vertices": 400, **options})


class Steps(WithFolder):
    def test_figures_are_the_programs(self):
        for model in ("cell", "paper"):
            sim = wilt.Simulation(leaf(seed=5), model, water__humidity=0.3, pin="free", **SMALL)
            result = sim.run()
            self.program("simulate", "maple", "--vertices", 400, "--seed", 5, "--model", model, "--iterations", 12,
                         "--frames", 4, "--set", "water.humidity=0.3", "--set", "pin=free", "--set", "texture.size=0",
                         "--report", "report.json")
            theirs, mine = json.loads((self.dir / "report.json").read_text()), result.report
            for report in (theirs, mine):
                del report["timings_s"]
            self.assertEqual(mine, theirs)
            self.assertEqual(sim.config, theirs["config"])
            self.assertEqual(result.positions_hash, theirs["positions_hash"])
            np.testing.assert_allclose(np.degrees(result.metrics["curl"]), [f["curl"] for f in theirs["frames"]], rtol=1e-8)
            np.testing.assert_allclose(result.steps["kinetic"], [s["kinetic"] for s in theirs["steps"]], rtol=1e-8)
            self.assertEqual(result.frames[-1].metrics.wrinkle, result.metrics["wrinkle"][-1])

    def test_iterating_stepping_and_running_are_the_same(self):
        subject = leaf("ivy")
        whole = wilt.Simulation(subject, **SMALL).run()
        iterated = wilt.Simulation(subject, **SMALL)
        self.assertEqual([state.iteration for state in iterated], list(range(1, 13)))
        stepped = wilt.Simulation(subject, **SMALL)
        while not stepped.ended:
            stepped.step()
        stepped.step()  # nothing happens any more
        seen = []
        called = wilt.Simulation(subject, **SMALL)
        called.run(lambda sim: seen.append(sim.iteration))
        self.assertEqual(seen, list(range(1, 13)))
        for sim in (iterated, stepped, called):
            self.assertEqual((sim.iteration, sim.last_iteration, sim.ended), (12, 12, True))
            self.assertEqual(sim.result.positions_hash, whole.positions_hash)
            self.assertTrue(sim.result.completed)

    def test_recorded_frames_are_the_states_of_their_iterations(self):
        sim = wilt.Simulation(leaf("ivy"), **SMALL)
        states = {0: sim.state, **{state.iteration: state for state in sim}}
        self.assertEqual([frame.iteration for frame in sim.result.frames], [0, 4, 8, 12])
        for frame in sim.result.frames:
            state = states[frame.iteration]
            np.testing.assert_array_equal(frame.positions, state.positions)
            np.testing.assert_array_equal(frame.dryness, state.dryness)
            np.testing.assert_array_equal(frame.colours, state.colours)
            self.assertEqual(frame.metrics.curl, state.metrics.curl)

    def test_a_callback_that_raises_stops_the_run_and_keeps_what_was_computed(self):
        def stop(sim):
            if sim.iteration == 3:
                raise LookupError("enough")

        sim = wilt.Simulation(leaf("ivy"), **SMALL)
        with self.assertRaisesRegex(LookupError, "enough"):
            sim.run(stop)
        early = sim.result
        self.assertEqual(early.frames[-1].iteration, 3)
        self.assertFalse(early.completed)
        self.assertEqual(early.stop_reason, "interrupted after iteration 3 of 12")
        self.assertEqual(sim.run().positions_hash, wilt.Simulation(leaf("ivy"), **SMALL).run().positions_hash)
        self.assertEqual(early.frames[-1].iteration, 3)

    def test_a_run_that_cannot_go_on_says_why_and_keeps_what_was_computed(self):
        sim = wilt.Simulation(leaf(), "paper", springs__stiffness=0.001, swelling__coefficient=100, iterations=50)
        self.assertLess(len(list(sim)), 50)
        self.assertTrue(sim.ended)
        result = sim.result
        self.assertFalse(result.completed)
        self.assertRegex(result.stop_reason, r"^iteration \d+: ")
        self.assertEqual(result.report["stopped"], result.stop_reason)
        with self.assertRaisesRegex(ValueError, "cannot be gone on with"):
            sim.checkpoint()


class Settings(WithFolder):
    def test_come_from_a_file_a_text_or_keywords_and_the_later_wins(self):
        (self.dir / "run.toml").write_text("model = \"paper\"\n[water]\nhumidity = 0.2\ntemperature_c = 30\n")
        for config in (self.dir / "run.toml", str(self.dir / "run.toml"), (self.dir / "run.toml").read_text()):
            sim = wilt.Simulation(leaf(), config=config, water__humidity=0.4)
            self.assertEqual([sim.config[key] for key in ("model", "water.humidity", "water.temperature_c")],
                             ["paper", 0.4, 30])
        self.assertEqual(wilt.Simulation(leaf(), "cell", config="model = 'paper'").config["model"], "cell")

    def test_resolved_give_the_same_simulation_again(self):
        sim = wilt.Simulation(leaf(seed=4), dt=0.05, veins__secondary=False, **SMALL)
        again = wilt.Simulation(leaf(seed=4), **sim.config)
        self.assertEqual(again.config, sim.config)
        self.assertEqual(again.run().positions_hash, sim.run().positions_hash)

    def test_dots_and_two_underscores_say_the_same(self):
        self.assertEqual(wilt.Simulation(leaf(), **{"water.humidity": np.float64(0.3)}).config,
                         wilt.Simulation(leaf(), water__humidity=0.3).config)

    def test_a_species_gives_a_foreign_leaf_its_parameters(self):
        grown = leaf()
        foreign = wilt.Leaf.from_arrays(grown.positions, grown.faces, petiole=grown.petiole)
        self.assertEqual(wilt.Simulation(foreign).config["species"], "generic")
        self.assertEqual(wilt.Simulation(foreign, species="willow").config["water.loss_rate"], 0.025)

    def test_given_veins_are_used_with_the_settings_they_were_found_with(self):
        subject = leaf()
        veins = subject.veins(secondary=False)
        sim = wilt.Simulation(subject, veins=veins, **SMALL)
        self.assertIs(sim.veins, veins)
        self.assertIs(sim.leaf, subject)
        self.assertFalse(sim.config["veins.secondary"])
        self.assertEqual(sim.run().positions_hash, wilt.Simulation(subject, veins__secondary=False, **SMALL).run().positions_hash)
        with self.assertRaisesRegex(ValueError, "another leaf's"):
            wilt.Simulation(leaf(), veins=veins)


class Changes(WithFolder):
    """Oracles: the program with the same [[change]]; the run that was changed elsewhere; the run that was not."""

    def test_settings_change_in_a_run_as_the_programs_do(self):
        subject = leaf("ivy")
        sim = wilt.Simulation(subject, **SMALL)
        for _ in range(5):
            sim.step()
        before = sim.checkpoint()
        sim.change(water__humidity=0.1, **{"springs.stiffness": 6})
        sim.change(water__dry_region=[0, 0, 0.5, 0, 0.5, 0.5])
        self.assertEqual(sim.config["change"], [{"iteration": 5, "springs.stiffness": 6, "water.dry_region": [0, 0, 0.5, 0, 0.5, 0.5],
                                                 "water.humidity": 0.1}])
        changed = sim.run()
        again = wilt.Simulation(subject, **sim.config).run()
        self.assertEqual(again.positions_hash, changed.positions_hash)
        self.assertEqual(again.report["config"], changed.report["config"])
        (self.dir / "run.toml").write_text("[[change]]\niteration = 5\nwater.humidity = 0.1\nsprings.stiffness = 6\n"
                                           "water.dry_region = [0, 0, 0.5, 0, 0.5, 0.5]\n")
        self.program("simulate", "ivy", "--vertices", 400, "--iterations", 12, "--frames", 4, "--set", "texture.size=0",
                     "--config", "run.toml", "--report", "report.json")
        self.assertEqual(json.loads((self.dir / "report.json").read_text())["positions_hash"], changed.positions_hash)
        sim.restore(before)
        self.assertNotIn("change", sim.config)
        self.assertEqual(sim.run().positions_hash, wilt.Simulation(subject, **SMALL).run().positions_hash)

    def test_what_may_not_change_is_refused_and_changes_nothing(self):
        sim = wilt.Simulation(leaf("ivy"), **SMALL)
        for settings in ({"dt": 0.2}, {"water__humidity": 0.1, "model": "paper"}, {"water__humidity": 2}, {"humidity": 1}):
            with self.assertRaises(ValueError):
                sim.change(**settings)
        self.assertNotIn("change", sim.config)
        for change in ([{"water.humidity": 1}], ["x"], [{"iteration": 0.5}], [{"iteration": 1, "dt": 1}]):
            with self.assertRaises(ValueError):
                wilt.Simulation(leaf("ivy"), change=change, **SMALL)


class Interrupts(unittest.TestCase):
    def test_ctrl_c_stops_a_run_which_may_go_on(self):
        sim = wilt.Simulation(leaf(), iterations=100000, frames=2)
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            sim.run()
        done = sim.iteration
        self.assertTrue(0 < done < 100000)
        self.assertEqual(sim.result.frames[-1].iteration, done)
        sim.step()
        other = wilt.Simulation(leaf(), iterations=100000, frames=2)
        for _ in range(done + 1):
            other.step()
        np.testing.assert_array_equal(sim.state.positions, other.state.positions)

    def test_what_a_signals_handler_raises_comes_out(self):
        def late(*_):
            raise TimeoutError("too late")

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, late))
        sim = wilt.Simulation(leaf(), iterations=100000, frames=2)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with self.assertRaisesRegex(TimeoutError, "too late"):
            sim.run()
        self.assertGreater(sim.iteration, 0)

    def test_ctrl_c_stops_the_search_for_veins(self):
        large = wilt.Leaf.from_species("maple", vertices=8000)
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(1000):
                large.veins()


class Threads(unittest.TestCase):
    def test_two_simulations_at_once_are_what_they_are_one_by_one(self):
        sims = {name: wilt.Simulation(leaf(name), iterations=40, frames=3) for name in ("maple", "willow")}
        expected = {name: wilt.Simulation(leaf(name), iterations=40, frames=3).run().positions_hash for name in sims}
        threads = [threading.Thread(target=sim.run) for sim in sims.values()]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual({name: sim.result.positions_hash for name, sim in sims.items()}, expected)

    def test_others_run_meanwhile_and_may_look(self):
        """Were Python's lock held, no iteration but the first and the last could be seen from here."""
        sim = wilt.Simulation(leaf(), iterations=60, frames=2)
        thread = threading.Thread(target=sim.run)
        thread.start()
        seen = []
        while thread.is_alive():
            state = sim.state
            seen.append(state.iteration)
            self.assertTrue(np.isfinite(state.velocities).all())
        thread.join()
        self.assertEqual(seen, sorted(seen))
        self.assertTrue(any(0 < iteration < 60 for iteration in seen), seen)

    def test_a_limit_changes_no_result(self):
        free = wilt.Simulation(leaf(), **SMALL).run().positions_hash
        with wilt.threads(1):
            self.assertEqual(wilt.Simulation(leaf(), **SMALL).run().positions_hash, free)


class Checkpoints(WithFolder):
    def test_are_gone_on_from_as_if_never_left(self):
        subject = leaf("tilia")
        whole = wilt.Simulation(subject, **SMALL)
        middle = None
        for state in whole:
            if state.iteration == 5:
                middle = whole.checkpoint()
        other = wilt.Simulation(subject, **SMALL)
        held = other.state.positions
        before = held.copy()
        other.restore(middle)
        self.assertEqual(other.iteration, 5)
        np.testing.assert_array_equal(held, before)  # of the simulation that was replaced
        self.assertEqual(other.run().report["steps"], whole.result.report["steps"])
        self.assertEqual(other.result.positions_hash, whole.result.positions_hash)
        self.assertEqual(other.checkpoint(), whole.checkpoint())

    def test_of_another_run_are_refused_and_nothing_changes(self):
        sim = wilt.Simulation(leaf(), **SMALL)
        sim.step()
        bytes_before = sim.checkpoint()
        for other, words in ((wilt.Simulation(leaf(seed=2), **SMALL), "seed was 2 and is 1"),
                             (wilt.Simulation(leaf(), water__humidity=0.2, **SMALL), "water.humidity was 0.2 and is 0.5")):
            with self.assertRaisesRegex(ValueError, words):
                sim.restore(other.checkpoint())
        for broken in (b"", b"nonsense", bytes_before[:-30]):
            with self.assertRaisesRegex(ValueError, "'checkpoint'"):
                sim.restore(broken)
        self.assertEqual(sim.checkpoint(), bytes_before)

    def test_are_the_programs(self):
        arguments = ["simulate", "maple", "--vertices", 400, "--iterations", 12, "--frames", 4, "--set", "texture.size=0"]
        self.program(*arguments, "-o", "whole.glb")
        sim = wilt.Simulation(leaf(), **SMALL)
        sim.step()
        (self.dir / "run.checkpoint").write_bytes(sim.checkpoint())
        resumed = self.program(*arguments, "-o", "resumed.glb", "--checkpoint", "run.checkpoint", "--resume")
        self.assertIn("resumed after iteration 1 of 12", resumed.stderr)
        self.assertEqual((self.dir / "resumed.glb").read_bytes(), (self.dir / "whole.glb").read_bytes())


if __name__ == "__main__":
    unittest.main()
