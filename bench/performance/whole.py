"""Whole processes: time by the wall, peak memory, the times of stages that wilt itself reports."""
import dataclasses
import json
import math
import os
import pathlib
import statistics
import subprocess
import time

from .table import Below, Row

STAGES = ("leaf", "geodesics", "embedding", "venation", "simulation", "output")
SIZES = (1000, 3000, 10000, 30000, 100000, 300000, 1000000)
LIMIT_S = 400  # a run that takes longer is ended
SHORT = 0.02   # stages below this many seconds say nothing about growth


@dataclasses.dataclass
class Process:
    seconds: float
    memory: int  # bytes, the largest resident set
    report: dict


def start(command):
    """Runs a command to its end; None when it fails or takes longer than LIMIT_S."""
    begin = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = begin + LIMIT_S
    pid = 0
    while pid == 0:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid == 0:
            if time.perf_counter() > deadline:
                process.kill()
                os.wait4(process.pid, 0)
                return None
            time.sleep(0.0005)
    process.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.perf_counter() - begin
    return Process(seconds, 1024 * usage.ru_maxrss, {}) if process.returncode == 0 else None


def simulate(wilt, folder, vertices, *options):
    """`wilt simulate maple` into a GLB, with its report."""
    report = pathlib.Path(folder) / "report.json"
    glb = pathlib.Path(folder) / "maple.glb"
    done = start([wilt, "simulate", "maple", "--vertices", str(vertices), *options, "-q", "-o", str(glb), "--report", str(report)])
    if done:
        done.report = json.loads(report.read_text())
        done.report = done.report["timings_s"]
    return done


def median(processes):
    """The one whose time is the median; None when any failed."""
    if not processes or None in processes:
        return None
    return sorted(processes, key=lambda p: p.seconds)[len(processes) // 2]


def rows(wilt, folder, quick):
    """The rows about whole processes, but for the largest leaf."""
    repetitions = 2 if quick else 5
    for stage, options, target, stretch in (("`simulate maple --vertices 2000 --model paper`", ("--model", "paper"), 0.3, 0.15),
                                            ("the same, default model", (), 1.0, 0.5)):
        done = median([simulate(wilt, folder, 2000, *options) for _ in range(repetitions)])
        yield filled(Row(stage, target=Below(target), stretch=Below(stretch)), done)
    yield filled(Row("`wilt --help`", target=Below(0.020)), median([start([wilt, "--help"]) for _ in range(20)]))


def filled(row, done):
    if done:
        row.ours, row.memory = done.seconds, done.memory if row.target.memory else 0.0
    else:
        row.notes.append(f"failed, or took longer than {LIMIT_S} s")
    return row


def largest_row(scaling):
    """The row of a million vertices, from the runs that scaling made."""
    row = Row("`simulate maple --vertices 1000000 --model paper`", target=Below(120.0, 4e9), stretch=Below(60.0), heavy=True)
    return filled(row, scaling[SIZES[-1]]) if SIZES[-1] in scaling else row


def scaling(wilt, folder, quick):
    """{vertices: Process or None} of model paper; stops at the first size that cannot be done."""
    done = {}
    for vertices in SIZES:
        if quick and vertices > 30000:
            break
        repetitions = 3 if vertices <= 10000 and not quick else 1
        done[vertices] = median([simulate(wilt, folder, vertices, "--model", "paper") for _ in range(repetitions)])
        if done[vertices] is None:
            break
    return done


def exponent(points):
    """The slope of log(time) over log(vertices), by least squares."""
    if len(points) < 2:
        return None
    logs = [(math.log(n), math.log(max(t, 1e-6))) for n, t in points]
    x, y = (statistics.fmean(values) for values in zip(*logs))
    return sum((a - x) * (b - y) for a, b in logs) / sum((a - x) ** 2 for a, _ in logs)


def stage_times(scaling_runs):
    """{stage: [(vertices, seconds)]}, "all" for the whole process."""
    times = {stage: [(n, p.report[stage]) for n, p in scaling_runs.items() if p] for stage in STAGES}
    return times | {"all": [(n, p.seconds) for n, p in scaling_runs.items() if p]}


def scaling_lines(scaling_runs):
    """As Markdown: seconds by stage and size, and how they grow."""
    sizes = [n for n, p in scaling_runs.items() if p]
    yield "| stage | " + " | ".join(f"{n:,}" for n in sizes) + " | exponent | its last decade | met (1.15) |"
    yield "|" + "---|" * (len(sizes) + 4)
    for stage, points in stage_times(scaling_runs).items():
        whole, last = exponent(points), exponent([p for p in points if p[0] >= sizes[-1] / 10])
        met = "" if whole is None else "yes" if whole <= 1.15 else "no"
        yield (f"| {stage} | " + " | ".join(f"{t:.3g}" for _, t in points) +
               f" | {whole:.2f} | {last:.2f} | {met} |")
    yield "| memory, MB | " + " | ".join(f"{1e-6 * scaling_runs[n].memory:.0f}" for n in sizes) + " | | | |"
