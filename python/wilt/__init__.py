"""Leaves that wither: a leaf in, its veins, water, wrinkles and files out.

    import wilt
    leaf = wilt.Leaf.from_species("maple")
    result = wilt.Simulation(leaf, water__humidity=0.3).run()
    result.save("maple.glb", "maple.png")

docs/python.md has the whole of it.
"""
from ._core import (FrameMetrics, Frame, Leaf, Plan, Result, Simulation, Species, State, Vein, Venation, __version__, count_leaves,
                    reproduce, settings, species, threads)

__all__ = ["Frame", "FrameMetrics", "Leaf", "Plan", "Result", "Simulation", "Species", "State", "Vein", "Venation", "count_leaves",
           "reproduce", "settings", "species", "threads"]
