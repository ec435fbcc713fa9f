#!/usr/bin/env python3
"""Checks that every scenario of wilt's own that stages.py names exists in its program. Usage: names.py BUILD_DIR"""
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.dont_write_bytecode = True
from performance.stages import Stages  # noqa: E402


def main():
    tools = Stages(sys.argv[1])
    scenarios = [row.scenario for row in tools.rows()] + [scenario for _, scenario in tools.kernels(quick=False)]
    listed = {}
    for scenario in scenarios:
        program = scenario.command[0]
        if program not in listed:
            listed[program] = subprocess.run([program, "--benchmark_list_tests"], check=True, capture_output=True, text=True).stdout
        if not re.search(rf"^{re.escape(scenario.name)}(/|$)", listed[program], re.MULTILINE):
            sys.exit(f"{program} has no benchmark '{scenario.name}'")
    print(f"{len(scenarios)} scenarios in {len(listed)} programs")


main()
