"""Which measurements there are: the stages with their peers and targets, other ways to step, other kernels."""
import pathlib
import shutil

from .programs import Scenario
from .table import Below, Ratio, Row

PEERS = pathlib.Path(__file__).resolve().parent.parent / "peers"
PYTHON = "/usr/bin/python3"  # Debian's own, which sees Debian's modules


class Stages:
    """Rows and scenarios for the programs under a build directory."""

    def __init__(self, build):
        self.bench = pathlib.Path(build) / "bench"

    def ours(self, room, name):
        return Scenario((str(self.bench / f"bench_{room}"),), name)

    def peer(self, program, name):
        return Scenario((str(self.bench / "peers" / f"peer_{program}"),), name, threads=1)

    def step(self, stage, name, target=None, stretch=None, bullet=True, **options):
        peers = {"Bullet": self.peer("bullet", f"bullet_step/{name}")} if bullet else {}
        return Row(stage, self.ours("mechanics", f"midpoint_step/{name}"), peers, target, stretch, per_spring=True, **options)

    def default_step(self, size, **options):
        return Row(f"step of the default model, {size}", self.ours("simulation", f"model_step/cell_{size}"),
                   {"Bullet, k = 1000": self.peer("bullet", f"bullet_step/stiff_{size}")}, Ratio(6), Ratio(14),
                   per_spring=True, repetitions=3, **options)

    def all_pairs(self, size, count, **options):
        heat = f"heat_all_pairs/{count}"
        return Row(f"near-exact geodesics, all pairs, {size}", self.ours("geodesics", f"fast_all_pairs/{count}"),
                   {"heat (CGAL)": self.peer("cgal", heat), "heat (CHOLMOD)": self.peer("heat", heat)}, Ratio(1), Ratio(2),
                   error_factor=40, **options)

    def rows(self):
        return [
            self.step("midpoint step of the springs, 1k", "soft_1k"),
            self.step("midpoint step of the springs, 10k", "soft_10k", Ratio(15), Ratio(25)),
            self.step("midpoint step of the springs, 100k", "soft_100k", Ratio(18), Ratio(36), repetitions=3),
            self.step("midpoint step of the springs, 1M", "soft_1M", Below(30e-9), Below(14e-9), bullet=False, repetitions=3, heavy=True),
            self.step("stiff step, k = 1000, 2k", "stiff_2k", Ratio(6), Ratio(14)),
            self.step("stiff step, k = 1000, 10k", "stiff_10k", Ratio(6), Ratio(14)),
            Row("16 leaves of one topology at once, 1k each", self.ours("mechanics", "batch_step/soft_1k"),
                {"Bullet": self.peer("bullet", "bullet_step/soft_1k")}, Ratio(20), Ratio(33), per_spring=True),
            self.default_step("2k"),
            self.default_step("5k", heavy=True),
            self.default_step("10k", heavy=True),
            self.all_pairs("1k", 1000),
            self.all_pairs("5k", 5000, repetitions=3, heavy=True),
            Row("exact geodesics, one source, 10k", self.ours("geodesics", "exact_one_source/10000"),
                {"CGAL": self.peer("cgal", "exact_one_source/10000")}, Ratio(25), Ratio(46), repetitions=3),
            Row("SMACOF iteration, 2k", self.ours("embedding", "smacof_iteration"),
                {"scikit-learn": self.sklearn()}, Ratio(50), Ratio(130), same_stress=True, repetitions=3),
        ]

    def sklearn(self):
        return Scenario((PYTHON, str(PEERS / "peer_sklearn.py"), str(self.bench / "write_workload")), "smacof_iteration")

    def blender(self, name, stiffness, vertices):
        program = shutil.which("blender") or "blender"
        return Scenario((program, "-b", "--factory-startup", "-t", "1", "-P", str(PEERS / "peer_blender.py"), "--",
                         str(self.bench / "write_workload"), str(vertices), str(stiffness), name), name)

    def other_ways(self):
        """Other ways to step the same springs: (scenario's name, way, Scenario)."""
        for name, stiffness, vertices in (("soft_1k", 4, 1000), ("soft_10k", 4, 10000), ("stiff_2k", 1000, 2000)):
            yield name, "Bullet, backward Euler, one Newton step", self.peer("bullet", f"bullet_step/{name}")
            yield name, "midpoint to 1e-8, Newton, Eigen CG", self.peer("eigen", f"eigen_step/{name}")
            yield name, "midpoint to 1e-8, Newton, CHOLMOD", self.peer("cholmod", f"cholmod_step/{name}")
            yield name, "Blender cloth, backward Euler", self.blender(f"blender_step/{name}", stiffness, vertices)
            yield name, "wilt, midpoint to 1e-8", self.ours("mechanics", f"midpoint_step/{name}")

    def kernels(self, quick):
        """What has no peer: (what, Scenario)."""
        yield "maple leaf, mesh, 2k", self.ours("leaf", "make_maple/2000")
        yield "the same, 100k", self.ours("leaf", "make_maple/100000")
        if not quick:
            yield "the same, 1M", self.ours("leaf", "make_maple/1000000")
        yield "fast geodesics, one source, 100k", self.ours("geodesics", "fast_one_source/100000")
        if not quick:
            yield "exact geodesics, one source, 100k", self.ours("geodesics", "exact_one_source/100000")
        yield "classical scaling, 2k", self.ours("embedding", "classical_start")
        yield "60 landmarks, 100k", self.ours("embedding", "landmarks/100000")
        yield "permeation, a step, 2k", self.ours("water", "permeation/2000")
        yield "permeation, a step, 100k", self.ours("water", "permeation/100000")
        yield "step of model paper, 2k", self.ours("simulation", "model_step/paper_2k")
        yield "metrics of a frame, 2k", self.ours("simulation", "metrics")
        yield "texture, 1024 x 1024", self.ours("simulation", "texture/1024")
        yield "relief, 1024 x 1024", self.ours("simulation", "relief/1024")
        yield "clip of a run with its textures, 2k, 26 frames", self.ours("output", "clip/2000")
        yield "bytes of a GLB, 2k, 26 frames", self.ours("output", "bytes/2000")
        yield "bytes of a GLB, 100k, 26 frames", self.ours("output", "bytes/100000")
        yield "file of 10 MB, flushed", self.ours("output", "file/10000000")
