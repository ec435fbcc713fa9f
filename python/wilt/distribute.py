"""Makes the items of a plan on many machines, with Dask (Debian's python3-distributed).

    python3 -m wilt.distribute plan.toml -o leaves                            workers on this machine
    python3 -m wilt.distribute plan.toml -o leaves --scheduler tcp://host:8786   those of a running cluster

The files are those that `wilt batch` writes, byte for byte, whichever machine makes which item. Workers may die, join and
leave; an item whose worker dies is made by another. What is whole already is not made again. docs/many-machines.md.
"""
import argparse
import contextlib
import hashlib
import logging
import os
import pathlib
import queue
import signal
import sys
import tempfile
import threading
import time

os.environ.setdefault("DASK_LOGGING__DISTRIBUTED", "critical")  # what matters is said here
import dask  # noqa: E402
from distributed import Client, KilledWorker, LocalCluster  # noqa: E402

import wilt  # noqa: E402

QUEUED = 2  # items a worker's thread has been given, so that it never waits for the next
RETRIES = 2  # of an item whose files could not be written
WORKER_DEATHS = 3  # with an item in hand or waiting, before it is suspected of killing them
# Of Dask's records of itself, which cost time and memory, for a cluster of our own.
LEAN = {"distributed.worker.profile.enabled": False, "distributed.scheduler.transition-log-length": 1000,
        "distributed.scheduler.events-log-length": 1000}

_thread = threading.local()


def _text_hash(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def _plan(path, text_hash, version):
    """The plan as this worker's thread reads it, once; the same that the others work on."""
    known = (path, text_hash)
    if getattr(_thread, "known", None) != known:
        if version != wilt.__version__:
            raise ValueError(f"this worker has wilt {wilt.__version__}, the plan is given out by {version}; install the same")
        if _text_hash(path) != text_hash:
            raise ValueError(f"'{path}' is not the same on all machines, or it has changed since the run began; "
                             "put it where all see it")
        _thread.plan, _thread.known = wilt.Plan.read(path), known
    return _thread.plan


def make_item(path, text_hash, version, directory, item, threads, retry):
    """Makes one item, on a worker."""
    plan = _plan(path, text_hash, version)
    with wilt.threads(threads):
        return plan.run_item(item, directory, retry=retry)


def dask_setup(_worker):
    """Called by Dask as a worker of our own starts: Ctrl-C is for the one who began the run."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


class Progress:
    """How far it is, on the terminal as `wilt batch` shows it: a line that is drawn anew, elsewhere one in 30 s."""

    def __init__(self, total, quiet=False, stream=sys.stderr):
        self.total, self.quiet, self.stream = total, quiet, stream
        self.terminal = stream.isatty()
        self.start = time.monotonic()
        self.drawn, self.shown = self.start, False

    def show(self, tally, workers, at_once=False):
        now = time.monotonic()
        if self.quiet or (now - self.drawn < (0.1 if self.terminal else 30.0) and not at_once):
            return
        self.drawn = now
        done, elapsed = tally["made"] + tally["failed"] + tally["there"], now - self.start
        made = tally["made"] + tally["failed"]
        facts = f"{done} of {self.total}"
        if made > 0 and elapsed > 0.5:
            facts += f", {made / elapsed:.2g}/s, {self.time_left(elapsed * (self.total - done) / made)}"
        facts += f", {workers} worker{'' if workers == 1 else 's'}" + (f", {tally['failed']} failed" if tally["failed"] else "")
        if not self.terminal:
            print(f"items: {facts}", file=self.stream, flush=True)
            return
        share = done / max(self.total, 1)
        print(f"\r\033[K{'items':<12} [{'=' * int(24 * share):<24}] {100 * share:3.0f} %  {facts}", end="", file=self.stream,
              flush=True)
        self.shown = True

    @staticmethod
    def time_left(seconds):
        if seconds < 120:
            return f"{seconds:.0f} s left"
        return f"{seconds / 60:.0f} min left" if seconds < 7200 else f"{seconds / 3600:.1f} h left"

    def say(self, text, important=False):
        if self.quiet and not important:
            return
        print(("\r\033[K" if self.shown else "") + text, file=self.stream, flush=True)
        self.shown = False


class Stopped(Exception):
    """What keeps the rest of the items from being made; `code` is the exit code of wilt batch for it."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def _stopped_by(error):
    codes = {FileNotFoundError: 3, OSError: 5, ValueError: 2}
    code = next((code for kind, code in codes.items() if isinstance(error, kind)), 4)
    return Stopped(code, str(error) if code != 4 else f"{type(error).__name__}: {error}")


class Distribution:
    """The items of a plan on their way through a cluster.

    At most QUEUED tasks per thread of the cluster are under way, and a task's result is a small dict, so memory on the
    client, the scheduler and the workers does not grow with the plan.
    """

    def __init__(self, client, path, directory, threads=1, retry=False):
        self.client, self.threads, self.retry = client, threads, retry
        self.path, self.directory = os.path.abspath(path), os.path.abspath(directory)
        self.plan = wilt.Plan.read(self.path)
        self.text_hash = _text_hash(self.path)
        self.done = queue.SimpleQueue()
        self.under_way, self.suspects = {}, []
        # Names in the dashboard are stem-000017; the middle keeps two runs on one scheduler apart.
        self.name = f"{pathlib.Path(path).stem}-{os.urandom(4).hex()}"
        self.tally = {"made": 0, "there": 0, "failed": 0}
        self.asked, self.workers, self.slots = 0.0, 0, 1

    def run(self, items, progress):
        """Makes the items that are not whole. Throws Stopped."""
        try:
            self._make(self._missing(items), progress)
            # A worker that dies takes the items that wait for it along. One at a time shows which of them did it.
            while self.suspects:
                item = self.suspects.pop()
                self._make(iter([item]), progress)
                if item in self.suspects:
                    self.suspects.remove(item)
                    reason = "every worker that began to make it died"
                    self.plan.record_failure(item, self.directory, reason)
                    self._count(item, "failed", reason, progress)
            progress.show(self.tally, self.workers, at_once=progress.terminal)
        finally:
            self.client.cancel(list(self.under_way.values()))
            self.under_way.clear()

    def _missing(self, items):
        for item in items:
            if not self.plan.is_done(item, self.directory):
                yield item
            elif self.plan.run_item(item, self.directory)["state"] == "whole":  # makes nothing: it is done
                self.tally["there"] += 1
            elif self.retry:
                yield item
            else:
                self.tally["failed"] += 1

    def finish(self):
        """Writes the manifest and the layouts if every item is there, and says whether. What dead workers left goes."""
        return wilt.Plan.read(self.path).finish(self.directory)

    def _make(self, missing, progress):
        more = True
        while more or self.under_way:
            more = self._refill(missing, more)
            self._take(progress)
            progress.show(self.tally, self.workers)

    def _refill(self, missing, more):
        self._look_at_cluster()
        while more and len(self.under_way) < QUEUED * self.slots:
            item = next(missing, None)
            if item is None:
                return False
            future = self.client.submit(make_item, self.path, self.text_hash, wilt.__version__, self.directory, item,
                                        self.threads, self.retry, key=f"{self.name}-{item:06}", retries=RETRIES)
            self.under_way[item] = future
            future.add_done_callback(lambda _, item=item: self.done.put(item))
        return more

    def _look_at_cluster(self):
        if time.monotonic() - self.asked < 1.0:
            return
        self.asked = time.monotonic()
        workers = self.client.scheduler_info()["workers"].values()
        self.workers, self.slots = len(workers), max(1, sum(worker["nthreads"] for worker in workers))

    def _take(self, progress):
        try:
            item = self.done.get(timeout=0.2)
        except queue.Empty:
            return
        future = self.under_way.pop(item)
        if future.status == "finished":
            result = future.result()
            self._count(item, result["state"], result.get("reason", ""), progress)
        elif future.status == "error":
            error = future.exception()
            if not isinstance(error, KilledWorker):
                raise _stopped_by(error)
            self.suspects.append(item)
        else:
            raise Stopped(4, "the scheduler is gone, or somebody took the items back; what is whole is kept, the same command "
                             "goes on")

    def _count(self, item, state, reason, progress):
        self.tally["made" if state == "whole" else "failed"] += 1
        if state != "whole":
            progress.say(f"warning: item {item}: {reason}", important=True)


def parse_shard(text):
    index, _, of = text.partition("/")
    if not (index.isdecimal() and of.isdecimal() and 1 <= int(index) <= int(of)):
        raise Stopped(2, f"--shard is '{text}'; it takes two numbers like 3/7, the first from 1 to the second")
    return int(index), int(of)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(prog="python3 -m wilt.distribute", formatter_class=argparse.RawDescriptionHelpFormatter,
                                     description="Makes the items of a plan on many machines, with Dask.",
                                     epilog="Examples:\n"
                                            "  python3 -m wilt.distribute plan.toml -o leaves --workers 8\n"
                                            "  python3 -m wilt.distribute plan.toml -o leaves --scheduler tcp://host:8786\n\n"
                                            "PLAN and DIR must be the same files under the same names on all machines.")
    parser.add_argument("plan", metavar="PLAN.toml")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="where the items go, as with wilt batch")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--scheduler", metavar="ADDRESS", help="of a running scheduler: tcp://host:8786")
    where.add_argument("--workers", metavar="N", type=int, help="start N workers on this machine (one a core)")
    parser.add_argument("--shard", metavar="I/N", default="1/1", help="only items whose number leaves I - 1 divided by N")
    parser.add_argument("--retry", action="store_true", help="try again what has failed")
    parser.add_argument("--threads", metavar="N", type=int,
                        help="threads of one item (with --scheduler 1, else cores by workers, at least 1)")
    parser.add_argument("-q", "--quiet", action="store_true", help="warnings and errors only")
    return parser.parse_args(arguments)


@contextlib.contextmanager
def _connected(request):
    """A client of the scheduler that is asked for, or of one of our own."""
    with contextlib.ExitStack() as stack:
        if request.scheduler:
            try:
                yield stack.enter_context(Client(request.scheduler))
            except (OSError, ValueError) as error:
                raise Stopped(2, f"there is no scheduler at '{request.scheduler}' ({error}); start one with `dask scheduler`") \
                    from error
            return
        dask.config.set({"distributed.scheduler.allowed-failures": WORKER_DEATHS - 1, **LEAN})
        spill = stack.enter_context(tempfile.TemporaryDirectory(prefix="wilt-"))
        cluster = stack.enter_context(LocalCluster(
            n_workers=_local_workers(request), threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0",
            memory_limit=0, preload=[__name__], local_directory=spill, silence_logs=logging.CRITICAL))
        yield stack.enter_context(Client(cluster))


def _pages(client):
    """Where the scheduler shows workers and tasks: its plots (/status) need bokeh, these pages do not."""
    if "dashboard" not in client.scheduler_info()["services"]:
        return ""
    return ", its pages: " + client.dashboard_link.replace("/status", "/info/main/workers.html")


def _local_workers(request):
    return request.workers or os.cpu_count()


def _run(request, progress):
    index, of = parse_shard(request.shard)
    threads = request.threads or (1 if request.scheduler else max(1, os.cpu_count() // _local_workers(request)))
    with _connected(request) as client:
        distribution = Distribution(client, request.plan, request.output, threads, request.retry)
        items = range(index - 1, len(distribution.plan), of)
        progress.total = len(items)
        progress.say(f"{len(items)} items; scheduler {client.scheduler.address}{_pages(client)}")
        distribution.run(items, progress)
    tally = distribution.tally
    progress.say(f"{tally['made']} items made, {tally['there']} were there, {tally['failed']} failed; "
                 f"{time.monotonic() - progress.start:.0f} s")
    progress.say(f"all {len(distribution.plan)} items are there: {request.output}/manifest.jsonl" if distribution.finish()
                 else "the manifest is written by the run that makes the last item")
    if tally["failed"]:
        raise Stopped(4, f"{tally['failed']} items could not be made; {request.output}/failed says why, --retry tries them again")


def main(arguments=None):
    """The exit code; those of `wilt batch`."""
    request = parse_arguments(arguments)
    progress = Progress(0, request.quiet)
    try:
        _run(request, progress)
        return 0
    except KeyboardInterrupt:
        progress.say("error: interrupted; what is whole is kept, the same command goes on", important=True)
        return 130
    except Stopped as stopped:
        progress.say(f"error: {stopped}", important=True)
        return stopped.code
    except (ValueError, OSError) as error:
        progress.say(f"error: {error}", important=True)
        return _stopped_by(error).code


if __name__ == "__main__":
    # By its full name, so that workers on other machines find the functions by name too.
    from wilt.distribute import main as run
    sys.exit(run())
