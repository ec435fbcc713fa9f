"""A plan on Dask's workers gives what `wilt batch` gives.

Oracle: a serial run of the program, all files byte by byte. The scheduler and the workers are real, on loopback.
"""
import contextlib
import json
import os
import signal
import subprocess
import sys
import time
import unittest

from program import WithFolder, wilt as program

try:
    import distributed  # noqa: F401
except ImportError:
    print("skipped: Dask is not there (apt-get install python3-distributed)")
    sys.exit(77)

from wilt import distribute

PLAN = """
count = {count}
leaf = {leaf}
[settings]
vertices = 300
iterations = {iterations}
frames = 2
texture.size = 128
water.humidity = {{uniform = [0.2, 0.9]}}
[write]
files = ["leaf.glb"]
[dataset]
layouts = ["webdataset"]
"""
BROKEN = '{"outline": [[0, 0], [1, 1], [2, 2]]}'


def files_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def wait_until(true, seconds=600):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.05)


class Cluster(contextlib.ExitStack):
    """A scheduler, and workers that come and go."""

    def __init__(self, folder):
        super().__init__()
        self.file, self.log = folder / "scheduler.json", self.enter_context(open(folder / "dask.log", "w"))
        self.environment = dict(os.environ, DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES="1")
        self.folder = folder
        self.start("scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", self.file)
        wait_until(self.file.exists)

    def start(self, kind, *options):
        process = subprocess.Popen([sys.executable, "-m", f"distributed.cli.dask_{kind}", "--host", "127.0.0.1",
                                    *map(str, options)], stdout=self.log, stderr=self.log, env=self.environment)
        self.callback(process.wait)
        self.callback(process.terminate)
        return process

    def worker(self, *options):
        return self.start("worker", "--nthreads", "1", "--no-dashboard", "--scheduler-file", self.file, "--local-directory",
                          self.folder / "spill", *options)

    @property
    def address(self):
        return json.loads(self.file.read_text())["address"]


class Distributed(WithFolder):
    environment = dict(os.environ)

    def plan(self, count=24, leaf='"maple"', iterations=10):
        (self.dir / "plan.toml").write_text(PLAN.format(count=count, leaf=leaf, iterations=iterations))

    def serial(self, expected=0):
        done = program("batch", "plan.toml", "-o", "serial", "--jobs", 1, cwd=self.dir)
        self.assertEqual(done.returncode, expected, done.stderr)
        return files_of(self.dir / "serial")

    def begin(self, *options):
        return subprocess.Popen([sys.executable, "-m", "wilt.distribute", "plan.toml", "-o", "out", *map(str, options)],
                                cwd=self.dir, stderr=subprocess.PIPE, text=True, env=self.environment)

    def run_all(self, *options, expected=0):
        run = self.begin(*options)
        _, messages = run.communicate(timeout=600)
        self.assertEqual(run.returncode, expected, messages)
        return messages

    def items(self):
        folder = self.dir / "out" / "items"
        return [path for path in folder.glob("[0-9]*")] if folder.exists() else []

    def assert_same(self, expected):
        found = files_of(self.dir / "out")
        self.assertEqual(sorted(found), sorted(expected))
        self.assertEqual([name for name in expected if found[name] != expected[name]], [])


class Workers(Distributed):
    def test_one_is_killed_and_one_joins_and_the_files_are_those_of_a_serial_run(self):
        self.plan()
        expected = self.serial()
        self.assertIn("items/000023/leaf.glb", expected)
        self.assertIn("webdataset/shard-000000.tar", expected)
        with Cluster(self.dir) as cluster:
            doomed, _ = cluster.worker("--no-nanny"), cluster.worker("--no-nanny")
            run = self.begin("--scheduler", cluster.address)
            wait_until(lambda: len(self.items()) >= 4)
            doomed.send_signal(signal.SIGKILL)
            self.assertEqual(doomed.wait(), -signal.SIGKILL)
            self.assertLess(len(self.items()), 24)
            cluster.worker("--no-nanny")
            _, messages = run.communicate(timeout=600)
            self.assertEqual(run.returncode, 0, messages)
            self.assertIn("24 items made, 0 were there, 0 failed", messages)
            self.assert_same(expected)

            # Again: nothing is computed.
            before = {path: path.stat().st_mtime_ns for path in self.items()}
            self.assertIn("0 items made, 24 were there, 0 failed", self.run_all("--scheduler", cluster.address))
            self.assertEqual({path: path.stat().st_mtime_ns for path in self.items()}, before)

    def test_an_item_that_kills_every_worker_is_recorded_and_the_rest_is_made(self):
        self.plan(count=12)
        expected = self.serial()
        poison = self.dir / "poison.py"
        poison.write_text("import os, wilt\n"
                          "def run_item(plan, item, directory, real=wilt.Plan.run_item, **more):\n"
                          "    if item == 5:\n"
                          "        os.kill(os.getpid(), 9)\n"
                          "    return real(plan, item, directory, **more)\n"
                          "wilt.Plan.run_item = run_item\n")
        with Cluster(self.dir) as cluster:
            for _ in range(2):
                cluster.worker("--preload", poison)  # with a nanny that starts it anew
            messages = self.run_all("--scheduler", cluster.address, expected=4)
        self.assertIn("item 5: every worker that began to make it died", messages)
        self.assertIn("11 items made, 0 were there, 1 failed", messages)
        found = files_of(self.dir / "out")
        self.assertIn("failed/000005.json", found)
        for name, content in expected.items():
            if name.startswith("items/") and not name.startswith("items/000005/"):
                self.assertEqual(found[name], content, name)
        # Without the poison it can be made after all.
        self.assertIn("0 items made, 11 were there, 1 failed", self.run_all("--workers", 1, expected=4))
        self.run_all("--workers", 1, "--retry")
        self.assert_same(expected)


class Runs(Distributed):
    def test_items_that_fail_are_recorded_as_by_the_program(self):
        self.plan(count=6, leaf='{grid = ["ivy", "broken.json"]}')
        (self.dir / "broken.json").write_text(BROKEN)
        expected = self.serial(expected=4)
        self.assertIn("failed/000001.json", expected)
        self.assertIn("3 items made, 0 were there, 3 failed", self.run_all("--workers", 2, expected=4))
        self.assert_same(expected)

    def test_ctrl_c_keeps_what_is_whole_and_shards_make_the_rest(self):
        self.plan(count=30, iterations=30)
        run = self.begin("--workers", 2)
        wait_until(lambda: len(self.items()) >= 3)
        run.send_signal(signal.SIGINT)
        _, messages = run.communicate(timeout=600)
        self.assertEqual(run.returncode, 130, messages)
        self.assertIn("interrupted", messages)
        self.assertFalse((self.dir / "out" / "manifest.jsonl").exists())
        self.assertIn("the manifest is written by the run", self.run_all("--workers", 1, "--shard", "1/2"))
        self.assertIn("all 30 items are there", self.run_all("--workers", 2, "--shard", "2/2"))
        self.assert_same(self.serial())

    def test_wrong_words_are_refused(self):
        self.plan()
        self.assertIn("two numbers like 3/7", self.run_all("--shard", "4/3", expected=2))
        self.environment = dict(os.environ, DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT="2s")
        self.assertIn("there is no scheduler at 'tcp://127.0.0.1:1'", self.run_all("--scheduler", "tcp://127.0.0.1:1",
                                                                                   expected=2))
        self.environment = dict(os.environ)
        (self.dir / "plan.toml").write_text("cuont = 3")
        self.assertIn("cuont", self.run_all("--workers", 1, expected=2))
        (self.dir / "plan.toml").unlink()
        self.run_all("--workers", 1, expected=3)


class FakeFuture:
    """Ends when the test says so."""

    def __init__(self, item):
        self.item, self.status = item, "pending"

    def add_done_callback(self, callback):
        self.callback = callback

    def result(self):
        return {"item": self.item, "state": "whole", "reason": ""}

    def end(self):
        self.status = "finished"
        self.callback(self)


class FakeClient:
    """A cluster of `threads` threads that makes nothing by itself."""

    def __init__(self, threads):
        self.threads, self.waiting, self.most, self.keys = threads, [], 0, []

    def scheduler_info(self):
        return {"workers": {"a": {"nthreads": self.threads}}}

    def submit(self, _function, _path, _hash, _version, _directory, item, *_, key, **__):
        self.keys.append(key)
        future = FakeFuture(item)
        self.waiting.append(future)
        self.most = max(self.most, len(self.waiting))
        return future

    def cancel(self, futures):
        assert futures == []


class Window(Distributed):
    def test_no_more_items_are_under_way_than_the_workers_can_hold(self):
        """Property: of a plan of 300 items at most two a thread are given out, each once, under names of their own."""
        self.plan(count=300)
        client = FakeClient(threads=3)
        distribution = distribute.Distribution(client, self.dir / "plan.toml", self.dir / "out")

        take = distribution._take

        def end_the_oldest_and_take(progress):
            client.waiting.pop(0).end()
            take(progress)

        distribution._take = end_the_oldest_and_take
        distribution.run(range(300), distribute.Progress(300, quiet=True))
        self.assertEqual(distribution.tally, {"made": 300, "there": 0, "failed": 0})
        self.assertEqual(client.most, 6)
        self.assertEqual(len(set(client.keys)), 300)
        self.assertTrue(all(key.startswith("plan-") and key.endswith(f"-{item:06}") for item, key in enumerate(client.keys)))


if __name__ == "__main__":
    unittest.main(verbosity=2)
