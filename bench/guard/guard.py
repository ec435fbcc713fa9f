#!/usr/bin/env python3
"""Counts the instructions of small cases with valgrind and compares them with budgets.json.

Usage: guard.py BENCH_GUARD [--update]

A case more than 5 % above its budget fails; one more than 20 % below passes and asks for a lower budget. Counts belong to
one compiler and its flags (others skip) and to the kernels' versions for any x86-64 processor. --update writes
budgets.json anew.
"""
import json
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

BUDGETS = pathlib.Path(__file__).resolve().parent / "budgets.json"
TOLERANCE, ROOM = 0.05, 0.20
SKIPPED = 77


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(SKIPPED)


def count(program, case, folder):
    out = pathlib.Path(folder) / case
    subprocess.run(["valgrind", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}", program, case],
                   check=True, capture_output=True)
    counted = int(re.search(r"^totals: (\d+)", out.read_text(), re.MULTILINE)[1])
    return counted or skip("bench_guard was built without valgrind/callgrind.h (Debian: valgrind)")


def verdict(counted, budget):
    """(whether it fails, the line's end)"""
    if budget is None:
        return True, "has no budget"
    change = f"of {budget:12,} ({counted / budget - 1:+.1%})"
    if counted > (1 + TOLERANCE) * budget:
        return True, change + " ABOVE"
    return False, change + (" well below: lower the budget" if counted < (1 - ROOM) * budget else "")


def main():
    program, *options = sys.argv[1:] or sys.exit(__doc__)
    update = options == ["--update"]
    if options and not update:
        sys.exit(__doc__)
    if not shutil.which("valgrind"):
        skip("there is no valgrind (Debian: valgrind)")
    if platform.machine() != "x86_64":
        skip(f"the budgets are for x86_64, this is {platform.machine()}")
    built_with, *cases = subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
    recorded = json.loads(BUDGETS.read_text()) if BUDGETS.exists() else {}
    if not update and recorded["built_with"] != built_with:
        skip(f"the budgets are for {recorded['built_with']}, this is {built_with}")

    budgets = recorded.get("instructions", {})
    with tempfile.TemporaryDirectory() as folder:
        counts = {case: count(program, case, folder) for case in cases}
    failed = []
    for case, counted in counts.items():
        fails, text = verdict(counted, budgets.get(case))
        failed += [case] * fails
        print(f"{case:20} {counted:12,} {text}")
    if update:
        BUDGETS.write_text(json.dumps({"built_with": built_with, "instructions": counts}, indent=2) + "\n")
        print(f"wrote {BUDGETS.name}")
    elif failed or set(budgets) - set(counts):
        sys.exit("cases and budgets disagree; where that is meant, record them anew: scripts/performance --guard-update")


if __name__ == "__main__":
    main()
