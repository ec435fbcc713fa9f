"""scikit-learn's SMACOF on the workload's distances, from wilt's classical start: the time of an iteration.

Usage: peer_sklearn.py WRITE_WORKLOAD    prints Google Benchmark's JSON; its options are ignored
"""
import json
import subprocess
import sys
import time
import warnings

import numpy as np
from sklearn.manifold import smacof

VERTICES, ITERATIONS = 2000, 30
warnings.simplefilter("ignore", FutureWarning)  # of scikit-learn 1.2, about 1.4


def scale(distances, start, iterations, eps):
    points, _ = smacof(distances, n_components=2, init=start, n_init=1, max_iter=iterations, eps=eps)
    return points


def stress(distances, points):
    squares = np.sum(points**2, axis=1)
    lengths = np.sqrt(np.maximum(squares[:, None] + squares - 2.0 * points @ points.T, 0.0))
    return np.sum((lengths - distances) ** 2) / np.sum(distances**2)


def main():
    data = np.frombuffer(subprocess.run([sys.argv[1], "distances", str(VERTICES)], check=True, capture_output=True).stdout)
    count = int(data[0])
    distances, start = data[1 : 1 + count * count].reshape(count, count), data[1 + count * count :].reshape(count, 2)
    begin = time.perf_counter()
    scale(distances, start, ITERATIONS, -1.0)  # a negative eps never stops
    seconds = (time.perf_counter() - begin) / ITERATIONS
    reached = stress(distances, scale(distances, start, 300, 1e-9))
    print(json.dumps({"benchmarks": [{"name": "smacof_iteration", "real_time": 1e3 * seconds, "time_unit": "ms",
                                      "stress": reached}]}))


main()
