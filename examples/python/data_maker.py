"""A thousand labelled leaves: pictures with masks of leaf, veins and depth, and what was simulated, for training.

    python3 examples/python/data_maker.py [COUNT] [DIRECTORY]

Stopped and run again it goes on; on many machines: python3 -m wilt.distribute, docs/python.md.
"""
# %%
import concurrent.futures
import json
import multiprocessing
import os
import pathlib
import sys
import time

import wilt

PLAN = """
count = {count}
seed = 7
leaf = {{choice = ["maple", "poplar", "tilia", "ivy", "willow", "grape"]}}
[settings]
vertices = 800
iterations = {{choice = [0, 25, 50, 75, 100]}}
frames = 2
water.humidity = {{uniform = [0.1, 0.9]}}
shrinkage.amount = {{normal = [1.0, 0.2]}}
texture.size = 512
[pictures]
size = [160, 160]
samples = 16
maps = ["leaf", "vein", "depth"]
azimuth = {{uniform = [-180, 180]}}
elevation = {{uniform = [30, 80]}}
[dataset]
layouts = ["coco"]
"""


# %% An item is made by whichever process is free; it depends on the plan and its number alone.
plan = None


def begin(text):
    global plan
    plan = wilt.Plan(text)


def make(item, folder):
    with wilt.threads(1):
        return plan.run_item(item, folder)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "out/data_maker")
    text = PLAN.format(count=count)
    begin(text)
    print("item 0 will be", plan.item(0)["chosen"])
    missing = [item for item in range(len(plan)) if not plan.is_done(item, folder)]
    print(f"{len(missing)} of {len(plan)} leaves are to be made")

    # %% Processes are spawned: a fork would lose the threads that wilt may have begun.
    start = time.monotonic()
    spawn = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count(), spawn, begin, (text,)) as pool:
        for done, report in enumerate(pool.map(make, missing, [folder] * len(missing)), 1):
            if report["state"] == "failed":
                print(f"\nitem {report['item']}: {report['reason']}")
            print(f"\r{done} of {len(missing)}, {done / (time.monotonic() - start):.1f}/s", end="", flush=True)
    print()
    if plan.finish(folder):
        print(f"all are there: {folder}/manifest.jsonl, {folder}/coco.json")

    # %% What an item says of itself, for a loader of your own.
    label = json.loads((folder / "items" / "000000" / "item.json").read_text())
    print("files of item 0:", ", ".join(label["files"]))
    print("last metrics:", label["metrics"])


if __name__ == "__main__":
    main()
