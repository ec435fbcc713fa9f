"""A pass over the springs against what the machine can do at most."""
import dataclasses

from . import programs

SIZES = {"1k": 1000, "10k": 10000, "100k": 100000, "1M": 1000000}
# Working sets of the triad, bytes, and the level of a processor's memory that holds them, on the machine of the page.
LEVELS = {30000: "L1", 750000: "L2", 6000000: "L3", 400000000: "memory"}

# Counted from iterate_groups() in mechanics/chebyshev_midpoint.cpp, the pass that a step of springs repeats. A spring has
# two slots, one at each end, and a third of a vertex. Vectors of vertices are read or written once; what gathers find in
# cache is not counted again.
# Slot: index (4), pull and push (16). Vertex: u and next u (2 x 32), constant (24), direction read and written (48), weight
# and inertia (16).
BYTES_A_SPRING = 2 * 20 + 152 / 3
# Slot: x_j - x_i (3), its square (6), pull - push / length (1), times the edge (3), sum (3). Vertex: residual and its
# square (18), direction (9), next u (3).
SUMS_A_SPRING = 2 * 16 + 30 / 3
ROOTS_A_SPRING = 2 * 2  # a root and a quotient a slot
OPERATIONS_A_SPRING = SUMS_A_SPRING + ROOTS_A_SPRING


@dataclasses.dataclass
class Roofline:
    bandwidth: dict  # level: bytes a second
    sums: float      # products and sums a second
    roots: float     # roots and quotients a second
    passes: dict     # size: seconds a spring

    @property
    def arithmetic(self):
        """Operations a second in the pass's mixture; products and sums run beside roots and quotients."""
        return OPERATIONS_A_SPRING / max(SUMS_A_SPRING / self.sums, ROOTS_A_SPRING / self.roots)


def measure(stages, quick):
    """On one thread. Throws programs.Failed."""
    def alone(room, name):
        return programs.run(dataclasses.replace(stages.ours(room, name), one_thread=True))

    bandwidth = {level: alone("machine", f"triad/{size}").counters["bytes_per_second"] for size, level in LEVELS.items()}
    sums, roots = (alone("machine", f"arithmetic/{kind}").counters["operations"]
                   for kind in ("products_and_sums", "roots_and_quotients"))
    passes = {}
    for label, size in SIZES.items():
        if quick and size > 100000:
            continue
        step = alone("mechanics", f"midpoint_step/soft_{label}")
        passes[label] = step.seconds / step.counters["springs"] / step.counters["linear"]
    return Roofline(bandwidth, sums, roots, passes)


def home(label):
    """The level that holds all that a pass touches."""
    touched = 3 * SIZES[label] * BYTES_A_SPRING
    return next((level for size, level in LEVELS.items() if touched <= 1.3 * size), "memory")


def lines(figures):
    """As Markdown."""
    yield "| vertices | a spring and pass | touched | in | bound by its bandwidth | by arithmetic | reached |"
    yield "|---|---|---|---|---|---|---|"
    arithmetic = OPERATIONS_A_SPRING / figures.arithmetic
    for label, seconds in figures.passes.items():
        level = home(label)
        memory = BYTES_A_SPRING / figures.bandwidth[level]
        yield (f"| {label} | {1e9 * seconds:.2f} ns | {3e-6 * SIZES[label] * BYTES_A_SPRING:.3g} MB | {level} | "
               f"{1e9 * memory:.2f} ns | {1e9 * arithmetic:.2f} ns | {max(memory, arithmetic) / seconds:.0%} |")
    yield ""
    yield "Triad on one thread, GB/s: " + ", ".join(f"{level} {1e-9 * b:.0f}" for level, b in figures.bandwidth.items()) + \
          f". In registers, a second: {1e-9 * figures.sums:.0f} G products and sums, {1e-9 * figures.roots:.1f} G roots and " \
          f"quotients. Counted for a spring and pass: {BYTES_A_SPRING:.0f} bytes, {SUMS_A_SPRING:.0f} products and sums, " \
          f"{ROOTS_A_SPRING} roots and quotients."
