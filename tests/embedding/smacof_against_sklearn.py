"""Differential test: wilt's SMACOF against scikit-learn's, on one matrix from one start."""
import subprocess
import sys
import warnings

try:
    import numpy as np
    from sklearn.manifold import smacof
except ImportError as error:
    print(f"SKIPPED: {error} (Debian: python3-sklearn)")
    sys.exit(77)


warnings.simplefilter("ignore", FutureWarning)  # of scikit-learn 1.2, about 1.4


def run(distances, start, iterations, eps):
    points, _ = smacof(distances, n_components=2, init=start, n_init=1, max_iter=iterations, eps=eps)
    return points


def stress(distances, points):
    lengths = np.linalg.norm(points[:, None] - points[None], axis=2)
    return np.sum((lengths - distances) ** 2) / np.sum(distances**2)


def main():
    values = np.array(subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout.split(), float)
    count, iterations, converged = int(values[0]), int(values[1]), values[2]
    distances, rest = values[3 : 3 + count * count].reshape(count, count), values[3 + count * count :]
    start, few = rest.reshape(2, count, 2)

    # The same recurrence: iterates agree to round-off, which ten steps amplify little. A negative eps never stops.
    theirs = run(distances, start, iterations, -1.0)
    difference = np.abs(theirs - few).max()
    print(f"after {iterations} iterations: largest difference of a coordinate {difference:.3g}")
    assert difference < 1e-12, difference

    final = stress(distances, run(distances, start, 5000, 1e-14))
    print(f"stress when converged: scikit-learn {final:.12g}, wilt {converged:.12g}")
    assert abs(final - converged) < 1e-6 * final, (final, converged)


main()
