"""Water and curl against humidity: the same leaf in air from damp to dry, as a figure and a table.

    python3 examples/python/plant_scientist.py [SPECIES] [DIRECTORY]
"""
# %%
import csv
import pathlib
import sys

import numpy as np

import wilt

species = sys.argv[1] if len(sys.argv) > 1 else "maple"
folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "out/plant_scientist")
folder.mkdir(parents=True, exist_ok=True)
humidities = np.linspace(0.1, 0.9, 9)

# %% The veins are found once; every run begins with the same leaf.
leaf = wilt.Leaf.from_species(species, vertices=1500)
veins = leaf.veins()

# %% A run per humidity. A state's arrays are by vertex: water of the tips against that of the whole blade, say.
runs = []
for humidity in humidities:
    simulation = wilt.Simulation(leaf, veins=veins, water__humidity=humidity, texture__size=0)
    hours_per_iteration = simulation.config["clip.hours"] / 100
    first = simulation.state.water
    rows = [(0.0, 1.0, 1.0, 0.0)]
    for state in simulation:
        rows.append((state.iteration * hours_per_iteration, state.water.sum() / first.sum(),
                     state.water[veins.tips].sum() / first[veins.tips].sum(), np.degrees(state.metrics.curl)))
    runs.append(np.array(rows).T)  # hours, water left, the same at the tips, curl
    print(f"humidity {humidity:.1f}: {100 * runs[-1][1, -1]:.0f} % of the water left, curl {runs[-1][3, -1]:.0f} degrees")

# %% The table.
with open(folder / f"{species}.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["humidity", "hours", "water", "water_tips", "curl_degrees"])
    for humidity, run in zip(humidities, runs):
        table.writerows([f"{humidity:.2f}", *(f"{value:.6g}" for value in row)] for row in run.T)

# %% The figure.
try:
    import matplotlib
except ImportError:
    sys.exit(f"{folder}/{species}.csv is written; for the figure: apt-get install python3-matplotlib")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
colours = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(runs)))
for humidity, run, colour in zip(humidities, runs, colours):
    left.plot(run[0], 100 * run[1], color=colour, label=f"{100 * humidity:.0f} %")
    middle.plot(run[0], run[3], color=colour)
left.set(xlabel="hours", ylabel="water left, %", title=f"{species}: drying")
left.legend(title="humidity", fontsize="x-small", title_fontsize="small")
middle.set(xlabel="hours", ylabel="curl, degrees", title="curling")
right.plot(100 * humidities, [run[3, -1] for run in runs], "o-", color="tab:brown", label="curl, degrees")
right.plot(100 * humidities, [100 * run[1, -1] for run in runs], "s-", color="tab:blue", label="water left, %")
right.set(xlabel="relative humidity, %", title=f"after {runs[0][0, -1]:.0f} hours")
right.legend()
figure.savefig(folder / f"{species}.png", dpi=120)
print(f"{folder}/{species}.png")
