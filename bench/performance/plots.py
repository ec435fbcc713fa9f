"""Plots by gnuplot, as SVG."""
import shutil
import subprocess

from . import roofline as roof

STYLE = """set terminal svg size {width},{height} dynamic font 'sans-serif,13' background '#ffffff'
set output '{path}'
set border 3 lc rgb '#666666'
set tics nomirror textcolor rgb '#333333'
set grid lc rgb '#e6e6e6'
set logscale xy
set format y '10^{{%L}}'
"""
COLOURS = ("#1b6e3a", "#c0562c", "#3a66a7", "#8a6d1f", "#7b4397", "#444444", "#999999")


def available():
    return shutil.which("gnuplot") is not None


def draw(path, script):
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
    return path


def block(name, points):
    return f"${name} << END\n" + "\n".join(f"{x} {y}" for x, y in points) + "\nEND\n"


def scaling(path, stage_times):
    """Seconds by stage over the number of vertices."""
    script = STYLE.format(width=760, height=480, path=path)
    script += "set xlabel 'vertices'\nset ylabel 'seconds'\nset format x '10^{%L}'\nset xrange [700:1500000]\nset key outside right top\n"
    curves = []
    for k, (stage, points) in enumerate(stage_times.items()):
        script += block(stage, points)
        dash = " dt 2" if stage == "all" else ""
        curves.append(f"${stage} with linespoints lw 2 pt 7 ps 0.5{dash} lc rgb '{COLOURS[k % len(COLOURS)]}' title '{stage}'")
    first, second = stage_times["all"][0], stage_times["all"][-1]
    scale = second[1] / second[0] ** 1.15
    curves.append(f"[{first[0]}:{second[0]}] {scale} * x**1.15 with lines lw 1 dt 3 lc rgb '#bbbbbb' title 'n^{{1.15}}'")
    return draw(path, script + "plot " + ", \\\n  ".join(curves) + "\n")


def roofline(path, figures):
    """Operations a second over operations a byte: roofs by memory level, the pass at each size."""
    peak = figures.arithmetic
    script = STYLE.format(width=760, height=480, path=path)
    script += ("set xlabel 'operations a byte'\nset ylabel 'operations a second'\nset format x '%g'\n"
               f"set xrange [0.03:10]\nset yrange [1e9:{3 * peak}]\nset key outside right top\n")
    curves = [f"(x * {rate} < {peak} ? x * {rate} : {peak}) with lines lw 2 lc rgb '{COLOURS[k % len(COLOURS)]}' title '{level}'"
              for k, (level, rate) in enumerate(figures.bandwidth.items())]
    intensity = roof.OPERATIONS_A_SPRING / roof.BYTES_A_SPRING
    for k, (label, seconds) in enumerate(figures.passes.items()):
        script += block(f"pass{label}", [(intensity, roof.OPERATIONS_A_SPRING / seconds)])
        curves.append(f"$pass{label} with points pt {(7, 5, 9, 13)[k % 4]} ps 1.2 lc rgb '#222222' title 'pass, {label} vertices'")
    return draw(path, script + "plot " + ", \\\n  ".join(curves) + "\n")
