"""Running benchmark programs, wilt's and its peers', and taking what they measured."""
import dataclasses
import json
import os
import re
import statistics
import subprocess

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


class Failed(Exception):
    """A program that did not give a measurement; the text says why."""


@dataclasses.dataclass(frozen=True)
class Scenario:
    """One named measurement: a command that prints Google Benchmark's JSON, and the name to take from it.

    `one_thread` holds the program to one processor; `threads` is what numerical libraries are told to use.
    """
    command: tuple
    name: str
    one_thread: bool = False
    threads: int = 0

    def missing(self):
        return None if os.path.exists(self.command[0]) else f"no {os.path.basename(self.command[0])}"


@dataclasses.dataclass
class Sample:
    seconds: float
    processors: float  # that were busy with it, on average
    counters: dict


def _environment(threads):
    environment = dict(os.environ)
    if threads:
        environment |= {"OMP_NUM_THREADS": str(threads), "OPENBLAS_NUM_THREADS": str(threads)}
    return environment


def run(scenario, limit=600):
    """Runs it once. Throws Failed."""
    arguments = [f"--benchmark_filter=^{re.escape(scenario.name)}(/|$)", "--benchmark_format=json"]
    first = sorted(os.sched_getaffinity(0))[0]
    try:
        process = subprocess.run([*scenario.command, *arguments], env=_environment(scenario.threads), timeout=limit,
                                 capture_output=True, text=True, check=True,
                                 preexec_fn=(lambda: os.sched_setaffinity(0, {first})) if scenario.one_thread else None)
    except subprocess.TimeoutExpired:
        raise Failed(f"above {limit} s") from None
    except subprocess.CalledProcessError as error:
        raise Failed(error.stderr.strip().splitlines()[-1] if error.stderr.strip() else str(error)) from None
    # A script's host may print before it.
    found = re.search(r'^\{\s*"(context|benchmarks)".*', process.stdout, re.MULTILINE | re.DOTALL)
    rows = json.JSONDecoder().raw_decode(found[0])[0]["benchmarks"] if found else []
    if not rows:
        raise Failed(f"{scenario.name} gave no result")
    row = rows[0]
    if row.get("error_occurred"):
        raise Failed(row["error_message"])
    counters = {key: value for key, value in row.items() if isinstance(value, (int, float))}
    seconds = counters.get("median_seconds", SECONDS[row["time_unit"]] * row["real_time"])
    return Sample(seconds, row.get("cpu_time", 0.0) / max(row["real_time"], 1e-300), counters)


def quietness(scenario):
    """The share of all processors' time that a scenario gets which asks for all of it."""
    return run(scenario).processors / len(os.sched_getaffinity(0))


@dataclasses.dataclass
class Result:
    """Samples of one scenario; `problem` says why there are none."""
    scenario: Scenario
    samples: list = dataclasses.field(default_factory=list)
    problem: str = ""

    @property
    def seconds(self):
        return statistics.median(s.seconds for s in self.samples) if self.samples else None

    def counter(self, name):
        return self.samples[-1].counters.get(name) if self.samples else None


def interleave(scenarios, repetitions, limit=600):
    """One Result a scenario, measured in turn: a, b, c, a, b, c, ..., so that all see the same weather."""
    results = [Result(s, problem=s.missing() or "") for s in scenarios]
    for _ in range(repetitions):
        for result in results:
            if result.problem:
                continue
            try:
                result.samples.append(run(result.scenario, limit))
            except Failed as error:
                result.problem = str(error)
    return results
