"""The table of stages: what is asked, what was measured, whether it is met."""
import dataclasses

from . import programs

QUIET = 0.9  # of the processors' time free: with less, a ratio says nothing


@dataclasses.dataclass(frozen=True)
class Ratio:
    """So many times as fast as the fastest peer."""
    times: float

    def met(self, row):
        return row.ratio is not None and row.ratio >= self.times

    def __str__(self):
        return f"{self.times:g}x"


@dataclasses.dataclass(frozen=True)
class Below:
    """A time, in seconds (per spring where the row counts springs), and memory in bytes."""
    seconds: float
    memory: float = 0.0

    def met(self, row):
        return row.ours is not None and row.ours <= self.seconds and (not self.memory or row.memory <= self.memory)

    def __str__(self):
        return time_text(self.seconds) + (f", {1e-9 * self.memory:g} GB" if self.memory else "")


@dataclasses.dataclass
class Row:
    """What is asked of a stage and, once measured, what came out. Seconds; per spring and step with `per_spring`."""
    stage: str
    scenario: programs.Scenario = None  # none: the whole process, measured elsewhere
    peers: dict = dataclasses.field(default_factory=dict)  # name: Scenario
    target: object = None
    stretch: object = None
    per_spring: bool = False
    error_factor: float = 0.0  # the fastest peer's mean error over ours must be at least this
    same_stress: bool = False  # the stress reached must be the peer's
    repetitions: int = 5
    heavy: bool = False  # left out by --quick
    ours: float = None
    single: float = None  # on one thread
    peer_times: dict = dataclasses.field(default_factory=dict)
    memory: float = 0.0
    quiet: float = None  # the share of the processors that was free when it was measured
    doubt: str = ""  # why the time does not count
    notes: list = dataclasses.field(default_factory=list)

    @property
    def fastest_peer(self):
        return min(self.peer_times, key=self.peer_times.get) if self.peer_times else None

    @property
    def ratio(self):
        return self.peer_times[self.fastest_peer] / self.ours if self.ours and self.peer_times else None

    @property
    def verdict(self):
        if self.ours is None:
            return "not run"
        if self.quiet and self.quiet < QUIET:
            return f"? only {self.quiet:.0%} of the machine was free"
        if self.doubt:
            return f"no: {self.doubt}"
        if self.target is None:
            return ""
        if self.stretch and self.stretch.met(self):
            return "stretch"
        return "yes" if self.target.met(self) else "no"


def measure(row, quick):
    """Peers and wilt in turn, wilt on all threads and on one."""
    single = dataclasses.replace(row.scenario, one_thread=True)
    repetitions = min(row.repetitions, 2) if quick else row.repetitions
    *peers, ours, alone = programs.interleave([*row.peers.values(), row.scenario, single], repetitions)
    row.notes += [f"{result.scenario.name}: {result.problem}" for result in (*peers, ours, alone) if result.problem]

    def time(result):
        if result.seconds is None:
            return None
        return result.seconds / result.counter("springs") if row.per_spring else result.seconds

    row.ours, row.single = time(ours), time(alone)
    row.peer_times = {name: time(peer) for name, peer in zip(row.peers, peers) if peer.samples}
    fastest = dict(zip(row.peers, peers)).get(row.fastest_peer)
    if not fastest or not ours.samples:
        return
    if row.per_spring and fastest.scenario.name.endswith(row.scenario.name.split("/")[1]):
        edge, theirs = ours.counter("edge"), fastest.counter("edge")
        if abs(edge - theirs) > 1e-3 * theirs:
            row.doubt = "another motion than the peer's"
    if row.error_factor:
        error, theirs = ours.counter("mean_error"), fastest.counter("mean_error")
        row.notes.append(f"mean error {error:.2g}, the peer's {theirs:.2g}")
        if error * row.error_factor > theirs:
            row.doubt = "not accurate enough"
    if row.same_stress:
        stress, theirs = ours.counter("stress"), fastest.counter("stress")
        row.notes.append(f"stress {stress:.6g}, the peer's {theirs:.6g}")
        if stress > 1.001 * theirs:
            row.doubt = "another optimum"


def time_text(seconds):
    if seconds is None:
        return "–"
    for limit, factor, unit in ((1e-6, 1e9, "ns"), (1e-3, 1e6, "µs"), (1.0, 1e3, "ms"), (float("inf"), 1.0, "s")):
        if seconds < limit:
            return f"{factor * seconds:.3g} {unit}"


def lines(rows):
    """As Markdown."""
    yield "| stage | fastest peer | its time | wilt | on one thread | ratio | target | stretch | met |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for row in rows:
        memory = f", {1e-9 * row.memory:.2g} GB" if row.memory else ""
        yield (f"| {row.stage} | {row.fastest_peer or '–'} | {time_text(row.peer_times.get(row.fastest_peer))} | "
               f"{time_text(row.ours)}{memory} | {time_text(row.single)} | "
               f"{f'{row.ratio:.3g}x' if row.ratio else '–'} | {row.target or '–'} | {row.stretch or '–'} | {row.verdict} |")
    notes = [f"{row.stage}: {note}." for row in rows for note in row.notes]
    if notes:
        yield ""
        yield from (f"- {note}" for note in notes)
