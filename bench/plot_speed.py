"""Draws the charts of bench/SPEED.md from the CSV files that report.py wrote.

    python3 bench/plot_speed.py RESULTS_FOLDER CHARTS_FOLDER
"""

import csv
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
from report import machine_name  # noqa: E402

# Text stays text, and the same numbers give the same file.
plt.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "metamorph", "font.size": 9, "axes.spines.top": False,
    "axes.spines.right": False, "axes.axisbelow": True, "figure.constrained_layout.use": True,
})
BLUE, RED, GREY, GREEN = "#3465a4", "#cc4125", "#9a9a9a", "#4e9a06"


class Results:
    def __init__(self, folder):
        with open(Path(folder) / f"{machine_name()}.csv", newline="") as file:
            self.rows = {(row["program"], row["benchmark"]): row for row in csv.DictReader(file)}

    def ns(self, program, name, column="cpu_ns_min"):
        row = self.rows.get(("bench_" + program, name))
        return float(row[column]) if row else None

    def series(self, program, pattern, column="cpu_ns_min"):
        """Points (number in the name, time) of the benchmarks whose name matches, ascending."""
        points = []
        for owner, name in self.rows:
            match = re.fullmatch(pattern, name)
            if owner == "bench_" + program and match:
                points.append((int(match.group(1)), self.ns(program, name, column)))
        return sorted(points)

    def counters(self, program, name):
        row = self.rows.get(("bench_" + program, name))
        return {k: float(v) for k, v in (c.split("=") for c in row["counters"].split())} if row else {}


def bars(axes, labels, values, colours, unit, digits=2):
    """Horizontal bars, the first on top, each with its number."""
    places = range(len(labels))
    axes.barh(places, values, color=colours, height=0.7)
    axes.set_yticks(places, labels)
    axes.set_ylim(len(labels) - 0.4, -0.6)
    axes.set_xlabel(unit)
    axes.set_xlim(0, max(values) * 1.15)
    for place, value in zip(places, values):
        axes.text(value, place, f" {value:.{digits}f}", va="center")


def arrangements(results):
    names = [("floor", "floor: the same arithmetic,\nno gathers"), ("library", "the library"),
             ("lane-is-node-hardware-gathers", "lane = node,\nhardware gathers"),
             ("scalar-tidy", "tidy scalar loop"),
             ("scalar-plain-arrays", "scalar loop,\nplain arrays"),
             ("lane-is-animat", "lane = animat,\nomp simd")]
    figure, both = plt.subplots(1, 2, figsize=(8, 3.2), sharey=True)
    for axes, precision in zip(both, ("float", "double")):
        found = [(label, results.ns("alternatives", f"{name}/{precision}/128"), name)
                 for name, label in names]
        bars(axes, [f[0] for f in found], [f[1] for f in found],
             [RED if f[2] == "library" else GREEN if f[2] == "floor" else GREY for f in found],
             "ns per spring and step")
        axes.set_title(f"{precision}, disc of 128 cells in water")
    return figure


def sizes(results):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2), sharey=True)
    for scene, precision, colour, style in (("water", "float", BLUE, "o-"),
                                            ("land", "float", RED, "s-"),
                                            ("water", "double", BLUE, "o:")):
        points = results.series("step", rf"size/{scene}/{precision}/(\d+)")
        left.plot(*zip(*points), style, color=colour, label=f"{scene}, {precision}", ms=4)
    left.set(xlabel="cells of the body", ylabel="ns per spring and step", xlim=(0, 264))
    left.legend(frameon=False)
    points = results.series("step", r"batch/water/float/(\d+)")
    right.plot(*zip(*points), "o-", color=BLUE, ms=4)
    right.set(xlabel="animats in the batch (64 cells each)", xscale="log")
    left.set_ylim(bottom=0)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    return figure


def scenes(results):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3))
    names = ["scene/water/float", "scene/land/float", "scene/slope/float",
             "scene/land-settling/float"]
    bars(left, ["water", "land", "slope", "land, settling"],
         [results.ns("step", name) for name in names], BLUE, "ns per spring and step")
    left.set_title("scenes, disc of 128 cells")
    cases = [("disc/water", "disc, water"), ("disc/land", "disc, land"),
             ("larvae/water", "evolved larvae, water"), ("adults/water", "evolved adults, water"),
             ("adults/land", "evolved adults, land")]
    without = [results.ns("step", f"collision/{case}/no-collision") for case, _ in cases]
    extra = [results.ns("step", f"collision/{case}/collision") - base
             for (case, _), base in zip(cases, without)]
    bars(right, [label for _, label in cases], [a + b for a, b in zip(without, extra)], RED,
         "ns per spring and step")
    right.barh(range(len(cases)), without, color=BLUE, height=0.7, label="step")
    right.barh([0], [0], color=RED, label="self-collision")
    right.set_xlim(right=1.7 * max(a + b for a, b in zip(without, extra)))
    right.set_title("self-collision on top")
    right.legend(frameon=False, loc="lower right", fontsize=8)
    return figure


def development(results):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 2.6))
    bars(left, ["CGAL, from nothing", "CGAL, links chosen", "repaired", "repaired, links chosen\nand listed"],
         [results.ns("development", name) / 1e3
          for name in ("triangulate", "renew_anew", "repair", "renew")],
         [GREY, GREY, RED, RED], "µs per renewal", 1)
    left.set_title("renewal of neighbours over a development")
    generation = results.counters("generation", "generation/water-to-land/threads:2")
    parts = [("develop_s", "development"), ("extract_s", "bodies"), ("locomotion_s", "locomotion")]
    bars(right, [label for _, label in parts], [generation[key] for key, _ in parts], BLUE,
         "s of wall time, two threads")
    right.set_title("one generation of 300, water to land")
    return figure


def scaling(results):
    figure, both = plt.subplots(1, 2, figsize=(8, 3), sharey=True)
    for axes, kind in zip(both, ("strong", "weak")):
        most = 1
        for work, colour in (("locomotion", BLUE), ("development", RED)):
            points = results.series("scaling", rf"{kind}/{work}/threads:(\d+)", "real_ns_min")
            axes.plot([t for t, _ in points], [points[0][1] / ns for _, ns in points], "o-",
                      color=colour, label=work, ms=4)
            most = max(most, points[-1][0])
        axes.plot([1, most], [1, most], ":", color=GREY, label="linear")
        axes.set(xlabel="threads", title="the same work" if kind == "strong" else "work per thread")
        axes.set_xticks(sorted({t for t, _ in points}))
        axes.grid(alpha=0.3)
    both[0].set_ylabel("work per time against one thread")
    both[0].legend(frameon=False)
    return figure


def main():
    results, charts = Results(sys.argv[1]), Path(sys.argv[2])
    charts.mkdir(parents=True, exist_ok=True)
    for draw in (arrangements, sizes, scenes, development, scaling):
        figure = draw(results)
        figure.savefig(charts / f"{draw.__name__}.svg", metadata={"Date": None})
        plt.close(figure)
    print(f"drawn: {charts}/*.svg")


if __name__ == "__main__":
    main()
