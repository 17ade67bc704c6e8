"""Charts (SVG) and tables (Markdown) of the accuracy studies.

usage: plot_accuracy.py TABLES CHARTS

TABLES holds what bench/accuracy.sh measured: work-precision-*.csv, stability.csv, ablation.csv,
settling.csv, solidity.csv, predictability.csv. Charts and accuracy-tables.md are written to CHARTS.
"""

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

plt.rcParams.update({"svg.hashsalt": "metamorph", "svg.fonttype": "none", "font.size": 8,
                     "axes.grid": True, "grid.color": "#e4e4e4", "axes.axisbelow": True,
                     "axes.spines.top": False, "axes.spines.right": False})
STYLE = {
    "DKD float32": ("#0b5fa5", "o"), "DKD float64": ("#5fa8e6", "o"), "DKD": ("#0b5fa5", "o"),
    "SE float32": ("#c4551a", "s"), "SE float64": ("#f0a070", "s"), "SE": ("#c4551a", "s"),
    "velocity Verlet": ("#2a8f5b", "^"), "midpoint": ("#999999", "v"), "RK4": ("#7a3fa0", "D"),
    "linearly implicit Euler": ("#8a6d1f", "P"), "ROS2": ("#1f7d8a", "p"),
    "XPBD": ("#c02a5a", "X")}
RAN = ("ok", "not_settled")


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def distinct(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def column(rows, key):
    return np.array([float(row[key]) for row in rows])


def quantiles(values):
    """Median, 90 % and worst of the finite values."""
    values = values[np.isfinite(values)]
    return np.quantile(values, [0.5, 0.9, 1.0]) if len(values) else np.full(3, np.nan)


def kendall_tau(a, b):
    """Pairs in the same order less those in the opposite one, over all that differ in both."""
    i, j = np.triu_indices(len(a), 1)
    agreement = np.sign(a[i] - a[j]) * np.sign(b[i] - b[j])
    differing = np.count_nonzero(agreement)
    return agreement.sum() / differing if differing else np.nan


def save(figure, charts, name):
    figure.savefig(charts / name, metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def measures(rows, truth):
    """What one method at one step does over all bodies, the failed ones left out of the errors."""
    ran = [row for row in rows if row["status"] in RAN]
    reference = np.array([truth[row["specimen"]] for row in rows])
    return {"evaluations": np.median(column(ran, "evaluations")) if ran else np.nan,
            "milliseconds": 1e3 * np.median(column(ran, "seconds")) if ran else np.nan,
            "distance": quantiles(column(ran, "distance_error")),
            "nodes": quantiles(column(ran, "node_error")),
            "tau": kendall_tau(column(rows, "distance"), reference),
            "failed": len(rows) - len(ran)}


def steps_of(rows, method):
    mine = [row for row in rows if row["method"] == method]
    return [(step, [row for row in mine if row["step"] == step]) for step in distinct(mine, "step")]


def bodies_apart(rows):
    """The default's ladder on the evolved bodies, on the others, and on those that the slow methods
    were tried on."""
    cells = []
    for scene in distinct(rows, "scene"):
        here = [row for row in rows if row["scene"] == scene]
        way = {row["specimen"]: abs(float(row["distance"])) for row in here
               if row["method"] == "reference" and row["status"] in RAN}
        groups = {"evolved": {row["specimen"] for row in here if row["evolved"] == "1"},
                  "random": {row["specimen"] for row in here if row["evolved"] == "0"}}
        for method in ("velocity Verlet", "ROS2"):
            tried = {row["specimen"] for row in here if row["method"] == method}
            if tried not in groups.values():
                groups[f"of {method}"] = tried
        for name, group in groups.items():
            known = [row for row in here if row["specimen"] in group and row["specimen"] in way]
            for method in ("DKD float32", "reference"):
                for step, mine in steps_of(known, method):
                    ran = [row for row in mine if row["status"] in RAN]
                    error = column(ran, "distance_error")
                    part = error / np.array([way[row["specimen"]] for row in ran])
                    cells.append([scene, name, method, step if float(step) else "",
                                  str(len(mine))] + [f"{v:.1e}" for v in quantiles(error)[:2]]
                                 + [f"{np.median(part):.1e}", str((part < 1e-3).sum()),
                                    str((part < 1e-2).sum()), str(len(mine) - len(ran))])
    return ("### Errors of the distance on part of the bodies\n\nIn d and in parts of the way; the "
            "last columns count the bodies whose error is below a thousandth and a hundredth of "
            "their way. The error of the reference is its own error bar.\n\n"
            + table(["scene", "bodies", "method", "step", "number", "median", "90 %",
                     "of the way: median", "< 1e-3", "< 1e-2", "failed"], cells) + "\n")


def work_precision(rows, charts):
    scenes = distinct(rows, "scene")
    figure, axes = plt.subplots(len(scenes), 3, figsize=(11, 2.7 * len(scenes)), squeeze=False)
    text = ""
    for line, scene in zip(axes, scenes):
        here = [row for row in rows if row["scene"] == scene]
        reference = [row for row in here if row["method"] == "reference"]
        good = [row for row in reference if row["status"] in RAN]
        known = {row["specimen"] for row in good}
        truth = {row["specimen"]: float(row["distance"]) for row in good}
        bar = {key: quantiles(column(good, key)) for key in ("distance_error", "node_error")}
        cells = []
        for method in [m for m in distinct(here, "method") if m != "reference"]:
            points = []
            for step, mine in steps_of([row for row in here if row["specimen"] in known], method):
                m = measures(mine, truth)
                points.append(m)
                cells.append([method, step, str(len(mine)), f"{m['evaluations']:.0f}",
                              f"{m['milliseconds']:.3g}"]
                             + [f"{v:.1e}" for v in m["distance"]]
                             + [f"{v:.1e}" for v in m["nodes"]]
                             + [f"{m['tau']:.3f}", str(m["failed"])])
            colour, marker = STYLE[method]
            options = {"color": colour, "marker": marker, "markersize": 4, "linewidth": 1.2}
            for axis, cost, error in ((line[0], "evaluations", "distance"),
                                      (line[1], "milliseconds", "nodes")):
                x = [p[cost] for p in points]
                axis.loglog(x, [p[error][0] for p in points], label=method, **options)
                axis.loglog(x, [p[error][1] for p in points], color=colour, linestyle=":",
                            linewidth=0.9)
            line[2].semilogx([p["evaluations"] for p in points], [p["tau"] for p in points],
                             **options)
        for axis, key in ((line[0], "distance_error"), (line[1], "node_error")):
            if bar[key][0] > 0:
                axis.axhline(bar[key][0], color="#555555", linewidth=0.8)
                axis.axhline(bar[key][1], color="#555555", linewidth=0.8, linestyle=":")
        line[0].set(title=f"{scene}: error of the distance", ylabel="d",
                    xlabel="force evaluations")
        line[1].set(title=f"{scene}: error of the nodes", ylabel="d (rms)",
                    xlabel="processor time of one animat, ms")
        line[2].set(title=f"{scene}: rank agreement", ylabel="Kendall's tau",
                    xlabel="force evaluations")
        failed = [row["specimen"] for row in reference if row["status"] not in RAN]
        text += (f"### Work and precision: {scene} ({len(good)} bodies)\n\nThe reference's own "
                 f"error bar (median / 90 % / worst): distance "
                 + " / ".join(f"{v:.1e}" for v in bar["distance_error"]) + ", nodes "
                 + " / ".join(f"{v:.1e}" for v in bar["node_error"]) + " d"
                 + (f"; without those that fail in the reference too: "
                    + ", ".join(failed) if failed else "") + ".\n\n"
                 + table(["method", "step", "bodies", "evaluations", "ms", "distance: median", "90 %",
                          "worst", "nodes: median", "90 %", "worst", "tau", "failed"], cells)
                 + "\n")
    figure.legend(*axes[0][0].get_legend_handles_labels(), fontsize=7, frameon=False, ncol=9,
                  loc="upper center", bbox_to_anchor=(0.5, 0.0))
    figure.suptitle("Median (lines) and 90 % (dotted) over all bodies; grey: the reference's own "
                    "error bar", y=1.0)
    figure.tight_layout()
    save(figure, charts, "work-precision.svg")
    failures = [row for row in rows if row["status"] not in RAN and row["method"] != "reference"]
    text += "### Failures\n\n" + table(
        ["scene", "method", "step", "failed bodies"],
        [[scene, method, step, ", ".join(f"{row['specimen']} ({row['status']})" for row in mine)]
         for scene in scenes for method in distinct(rows, "method")
         for step, mine in steps_of([r for r in failures if r["scene"] == scene], method)]) + "\n"
    return text


def one_body(rows, charts):
    """The evolved adult nearest to 100 cells, alone."""
    evolved = [row for row in rows if row["evolved"] == "1" and row["specimen"].endswith("adult")]
    name = min(evolved, key=lambda row: abs(int(row["cells"]) - 100))["specimen"]
    scenes = distinct(rows, "scene")
    figure, axes = plt.subplots(1, len(scenes), figsize=(3.2 * len(scenes), 2.8), squeeze=False)
    for axis, scene in zip(axes[0], scenes):
        mine = [row for row in rows if row["scene"] == scene and row["specimen"] == name]
        for method in distinct(mine, "method"):
            points = [row for row in mine if row["method"] == method and row["status"] in RAN]
            if method == "reference":
                for row in points:
                    axis.axhline(float(row["node_error"]), color="#555555", linewidth=0.8)
                continue
            colour, marker = STYLE[method]
            axis.loglog(column(points, "evaluations"), column(points, "node_error"), label=method,
                        color=colour, marker=marker, markersize=4, linewidth=1.2)
        axis.set(title=scene, xlabel="force evaluations", ylabel="error of the nodes, d (rms)")
    axes[0][0].legend(fontsize=6, frameon=False)
    figure.suptitle(f"One body ({name}); grey: the reference's own error bar", y=1.02)
    figure.tight_layout()
    save(figure, charts, "work-precision-one-body.svg")


def stability(rows, charts):
    label = {"damping": "damping c", "pressure": "pressure coefficient", "stiffness": "stiffness k",
             "drag speed": "drag coefficient x speed", "amplitude": "amplitude of actuation",
             "contact stiffness": "contact stiffness k_s, on land"}
    maps = distinct(rows, "map")
    figure, axes = plt.subplots(1, len(maps), figsize=(2.9 * len(maps), 2.8))
    cells = []
    for axis, name in zip(axes, maps):
        here = [row for row in rows if row["map"] == name]
        for method in distinct(here, "method"):
            mine = [row for row in here if row["method"] == method]
            colour, marker = STYLE[method]
            for specimen in distinct(mine, "specimen"):
                body = [row for row in mine if row["specimen"] == specimen]
                theory = column(body, "theory")
                theory[np.isinf(theory)] = np.nan
                axis.plot(column(body, "value"), theory, color=colour, linewidth=0.9)
                axis.plot(column(body, "value"), column(body, "measured"), color=colour,
                          marker=marker, markersize=3, linestyle="none",
                          label=method if specimen == mine[0]["specimen"] else None)
            measured, theory = column(mine, "measured"), column(mine, "theory")
            free = bool(np.isinf(theory[0]))
            value = measured if free else measured / theory
            cells.append([name, method + (" (no limit in theory: the step)" if free else ""),
                          f"{value.min():.3f}", f"{np.median(value):.3f}", f"{value.max():.3f}"])
        axis.set(xlabel=label[name], ylabel="largest stable step")
        axis.set(yscale="log", xscale="log" if name in ("stiffness", "drag speed", "contact stiffness")
                 else "linear")
    axes[0].legend(fontsize=7, frameon=False)
    bodies = ", ".join(sorted({row["cells"] for row in rows}, key=int))
    figure.suptitle(f"Measured by bisection (marks) and theory (lines); bodies of {bodies} cells",
                    y=1.02)
    figure.tight_layout()
    save(figure, charts, "stability.svg")
    return "### Largest stable step: measured over theory\n\n" + table(
        ["map", "method", "least", "median", "most"], cells) + "\n"


def against_default(rows, variant):
    base = {row["specimen"]: row for row in rows if row["variant"] == "default"}
    mine = [row for row in rows if row["variant"] == variant]
    reference = np.array([float(base[row["specimen"]]["distance"]) for row in mine])
    distance = column(mine, "distance")
    return mine, np.abs(distance - reference), kendall_tau(distance, reference)


def ablation(rows):
    text = ""
    for scene in distinct(rows, "scene"):
        for evolved, name in (("1", "evolved"), ("0", "random")):
            here = [r for r in rows if r["scene"] == scene and r["evolved"] == evolved]
            base = column([r for r in here if r["variant"] == "default"], "seconds").sum()
            steps = column([r for r in here if r["variant"] == "default"], "steps").sum()
            cells = []
            for variant in distinct(here, "variant"):
                mine, error, tau = against_default(here, variant)
                failed = sum(row["status"] not in RAN for row in mine)
                fit = {name: [row for row in here if row["variant"] == name
                              and row["status"] in RAN] for name in ("default", variant)}
                way = {row["specimen"]: abs(float(row["distance"])) for row in fit["default"]}
                both = [row for row in fit[variant] if row["specimen"] in way]
                further = sum(abs(float(row["distance"])) > way[row["specimen"]] for row in both)
                tau_both = against_default(fit["default"] + both if variant != "default" else both,
                                           variant)[2]
                cells.append([variant, f"{column(mine, 'steps').sum() / steps:.2f}",
                              f"{column(mine, 'seconds').sum() / base:.2f}"]
                             + [f"{v:.1e}" for v in quantiles(error)]
                             + [f"{tau:.3f}", f"{tau_both:.3f}", f"{further} of {len(both)}",
                                str(failed)])
            travelled = np.median(np.abs(column(
                [row for row in here if row["variant"] == "default"], "distance")))
            text += (f"### Ablation: {scene}, {name} bodies ({len(mine)}, median distance "
                     f"{travelled:.2g} d)\n\n"
                     + table(["variant", "steps", "time", "distance changes: median", "90 %",
                              "worst", "tau", "tau, if run", "further", "failed"], cells)
                     + "\n")
    return text


def settling(rows, charts):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    base = column([row for row in rows if row["variant"] == "default"], "settle_time").mean()
    evolved = [row for row in rows if row["evolved"] == "1"]
    cells = []
    for variant in distinct(rows, "variant"):
        mine, error, tau = against_default(rows, variant)
        tau_evolved = against_default(evolved, variant)[2]
        rest, pose = (quantiles(column(mine, key)) for key in ("rest_error", "pose_error"))
        time = column(mine, "settle_time")
        step = float(variant.split(" at ")[1]) if " at 0" in variant else 0.2
        cost = time.mean() / base * 0.2 / step
        unsettled = sum(row["status"] == "not_settled" for row in mine)
        failed = sum(row["status"] not in RAN for row in mine)
        cells.append([variant, f"{time.mean():.0f}", f"{cost:.2f}"]
                     + [f"{v:.1e}" for v in (rest[0], rest[1], pose[0], pose[1])]
                     + [f"{v:.1e}" for v in quantiles(error)[:2]]
                     + [f"{tau:.3f}", f"{tau_evolved:.3f}", str(unsettled), str(failed)])
        colour = "#0b5fa5" if variant.startswith("drag") else "#c4551a"
        for axis, y in ((axes[0], max(pose[1], 1e-7)), (axes[1], tau)):
            axis.plot(cost, y, "o", color=colour, markersize=3)
            axis.annotate(variant, (cost, y), fontsize=5.5, xytext=(3, 1),
                          textcoords="offset points")
    axes[0].set(yscale="log", xlabel="steps of settling, default 1",
                ylabel="difference of the pose at rest, 90 % of the bodies, d")
    axes[1].set(xlabel="steps of settling, default 1",
                ylabel="tau of the distances with the default's")
    figure.suptitle("Flat land: settling against its default", y=1.0)
    figure.tight_layout()
    save(figure, charts, "settling.svg")
    return (f"### Settling on flat land ({len(mine)} bodies)\n\n"
            + table(["variant", "time: mean", "steps", "rest: median", "90 %", "pose: median",
                     "90 %", "distance: median", "90 %", "tau", "tau, evolved", "not settled",
                     "failed"], cells) + "\n")


def predictability(rows, charts):
    figure, axes = plt.subplots(1, 3, figsize=(10, 2.8), sharey=True)
    cells = []
    for axis, scene in zip(axes, distinct(rows, "scene")):
        for evolved, name, colour in (("1", "evolved", "#c4551a"), ("0", "random", "#0b5fa5")):
            here = [r for r in rows if r["scene"] == scene and r["evolved"] == evolved]
            times = distinct(here, "time")
            values = [quantiles(column([r for r in here if r["time"] == t], "difference"))
                      for t in times]
            t = np.array([float(time) for time in times])
            axis.semilogy(t, [v[0] for v in values], color=colour, label=f"{name}, median")
            axis.semilogy(t, [v[1] for v in values], color=colour, linestyle=":",
                          label=f"{name}, 90 %")
            for at in (200, 600, 1200):
                v = values[int(np.argmin(np.abs(t - at)))]
                cells.append([scene, name, str(at)] + [f"{x:.1e}" for x in v])
        axis.axvline(600, color="#999999", linewidth=0.8)
        axis.set(title=scene, xlabel="time units of actuation")
    axes[0].set(ylabel="difference of the nodes, d (rms)")
    axes[0].legend(fontsize=7, frameon=False)
    figure.suptitle("A disturbance of 1e-6 d before settling (grey line: end of a run)", y=1.02)
    figure.tight_layout()
    save(figure, charts, "predictability.svg")
    return "### Growth of a disturbance of 1e-6 d\n\n" + table(
        ["scene", "bodies", "time", "median", "90 %", "worst"], cells) + "\n"


def solidity(rows):
    cells = []
    for scene in distinct(rows, "scene"):
        for evolved, name in (("1", "evolved"), ("0", "random")):
            here = [r for r in rows if r["scene"] == scene and r["evolved"] == evolved]
            cells.append([scene, name, str(len(here)), f"{column(here, 'frames').sum():.0f}",
                          f"{column(here, 'crossed').sum():.0f}",
                          f"{-column(here, 'lowest').min():.1e}",
                          str(sum(row["status"] not in RAN for row in here))])
    return ("### Frames in which an outline crosses itself\n\nEvery step of a run is a frame; "
            "crossings are decided exactly.\n\n"
            + table(["scene", "bodies", "number", "frames", "crossed", "deepest below the ground",
                     "failed"], cells) + "\n")


def main(tables, charts):
    charts.mkdir(parents=True, exist_ok=True)
    rows = [row for scene in ("water", "land-third", "land", "slope")
            for row in read(tables / f"work-precision-{scene}.csv")]
    text = ("# Tables of the accuracy studies\n\nWritten by bench/plot_accuracy.py from what "
            "bench/accuracy.sh measured; bench/ACCURACY.md says what they mean. Lengths in d, "
            "times in time units.\n\n")
    text += work_precision(rows, charts)
    text += bodies_apart(rows)
    one_body(rows, charts)
    text += stability(read(tables / "stability.csv"), charts)
    text += ablation(read(tables / "ablation.csv"))
    text += settling(read(tables / "settling.csv"), charts)
    text += solidity(read(tables / "solidity.csv"))
    text += predictability(read(tables / "predictability.csv"), charts)
    (charts / "accuracy-tables.md").write_text(text.rstrip() + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]))
