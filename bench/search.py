#!/usr/bin/env python3
"""Compares searches over several seeds: runs each, keeps what each generation was, prints and draws.

    python3 bench/search.py KEPT.csv FOLDER EXPERIMENT.toml POPULATION GENERATIONS SEEDS ARM...
    python3 bench/search.py KEPT.csv [--plot CHART.svg] [--arms NAME,NAME...] [--course GENERATION,...]

The first form evolves one run per arm and seed in FOLDER, as bench/arms.py does, and adds one row
per generation to KEPT.csv; what stands there already is not run again. The second form reads
KEPT.csv alone. Both print a Markdown table, per arm: the best eq 6 of a run, and over its last five
generations the population's mean eq 6, the species, the share of dead children and of those that are
better than both parents; medians over the seeds with quartiles. Against the first arm: A12, the chance
that a run of the arm is above one of the first (ties count half), and p of the Mann-Whitney test.
--course prints a second table, a row per run: its best eq 6 until each of these generations and until
its last one, and the fewest species from the first of them on.
"""

import argparse
import csv
import sqlite3
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import arms
from scipy.stats import mannwhitneyu

FIELDS = ["arm", "seed", "generation", "best", "mean", "species", "dead", "better"]
LAST = 5  # generations that a run's end is a mean over


def generations_of(folder):
    """What each generation of a run was: rows without arm and seed; None is not in the record."""
    with sqlite3.connect(f"file:{folder / 'run.db'}?mode=ro", uri=True) as record:
        tables = {name for name, in record.execute("SELECT name FROM sqlite_master")}
        species = (dict(record.execute("SELECT generation, species FROM populations"))
                   if "populations" in tables else {})
        better = (dict(record.execute("SELECT generation, 1.0 * sum(better) / sum(children) "
                                      "FROM origins GROUP BY generation"))
                  if "origins" in tables else {})
        dead = dict(record.execute(
            "SELECT generation, avg(eq6 = 0) FROM individuals GROUP BY generation"))
        return [[generation, best, mean, species.get(generation), dead[generation],
                 better.get(generation)] for generation, best, mean in record.execute(
                     "SELECT generation, best_eq6, mean_eq6 FROM generations ORDER BY 1")]


def read_kept(kept):
    """{(arm, seed): [[generation, best, mean, species, dead, better], ...]} in order of the file."""
    runs = {}
    if kept.exists():
        with kept.open(newline="") as file:
            for row in csv.DictReader(file):
                runs.setdefault((row["arm"], row["seed"]), []).append(
                    [float(row[field]) if row[field] else None for field in FIELDS[2:]])
    return runs


def evolve(kept, folder, experiment, population, generations, seeds, given):
    runs = read_kept(kept)
    jobs = []
    for seed in seeds.split(","):
        for arm in given:
            name, _, settings = arm.partition(":")
            if (name, seed) in runs:
                continue
            jobs.append((name, seed, (Path(folder) / f"{name}-{seed}", experiment, population,
                                      generations, seed, [s for s in settings.split(";") if s])))
    with ThreadPoolExecutor(arms.os.cpu_count()) as workers:
        for (name, seed, job), _ in zip(jobs, workers.map(arms.evolve, [job for *_, job in jobs])):
            is_new = not kept.exists()
            with kept.open("a", newline="") as file:
                out = csv.writer(file, lineterminator="\n")
                if is_new:
                    out.writerow(FIELDS)
                for generation, *values in generations_of(job[0]):
                    out.writerow([name, seed, generation] +
                                 ["" if value is None else f"{value:.5g}" for value in values])


def end_of(rows):
    """best of the run; mean, species, dead, better over its last generations; None is not known."""
    last = rows[-LAST:]
    return [max(row[1] for row in rows)] + [
        None if last[0][field] is None else sum(row[field] for row in last) / len(last)
        for field in (2, 3, 4, 5)]


def quartiles(values):
    values = sorted(values)

    def at(share):
        place = share * (len(values) - 1)
        low = int(place)
        high = min(low + 1, len(values) - 1)
        return values[low] + (place - low) * (values[high] - values[low])
    return at(0.5), at(0.25), at(0.75)


def against(values, first):
    if values is first or len(values) < 2 or len(first) < 2:
        return ""
    test = mannwhitneyu(values, first)
    return f", A12 {test.statistic / len(values) / len(first):.2f}, p {test.pvalue:.2g}"


def print_table(by_arm):
    print("| arm | runs | best eq 6, d | mean eq 6, d | species | dead | better |\n"
          "|---|---|---|---|---|---|---|")
    first = None
    for arm, runs in by_arm.items():
        ends = [[value for value in column if value is not None]
                for column in zip(*(end_of(rows) for rows in runs.values()))]
        first = first or ends
        cells = []
        for n, values in enumerate(ends):
            if not values:
                cells.append("-")
                continue
            median, low, high = quartiles(values)
            if n < 2:
                cells.append(f"{median:.1f} ({low:.1f}-{high:.1f}){against(values, first[n])}")
            elif n == 2:
                cells.append(f"{median:.0f} ({low:.0f}-{high:.0f})")
            else:
                cells.append(f"{100 * median:.0f} % ({100 * low:.0f}-{100 * high:.0f})")
        print(f"| {arm} | {len(runs)} | {' | '.join(cells)} |")


def print_course(by_arm, moments):
    print("\n| arm | seed | " + " | ".join(f"best until {moment}" for moment in moments)
          + " | best | fewest species |\n|" + "---|" * (len(moments) + 4))
    for runs in by_arm.values():
        for (arm, seed), rows in sorted(runs.items(), key=lambda run: int(run[0][1])):
            cells = [f"{max(row[1] for row in rows if row[0] <= moment):.1f}" for moment in moments]
            species = [row[3] for row in rows if row[0] >= moments[0] and row[3] is not None]
            print(f"| {arm} | {seed} | {' | '.join(cells)} | {end_of(rows)[0]:.1f} "
                  f"| {f'{min(species):.0f}' if species else '-'} |")


def plot(by_arm, chart):
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "metamorph"
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(2, 2, figsize=(9, 6), sharex=True, layout="constrained")
    panels = [("best eq 6 so far, d", 1), ("mean eq 6 of the population, d", 2), ("species", 3),
              ("dead children, %", 4)]
    for axis, (title, field) in zip(axes.flat, panels):
        for arm, runs in by_arm.items():
            if any(row[field] is None for rows in runs.values() for row in rows):
                continue  # a search without species
            series = []
            for rows in runs.values():
                values = [row[field] * (100 if field == 4 else 1) for row in rows]
                if field == 1:
                    values = [max(values[:g + 1]) for g in range(len(values))]
                series.append(values)
            length = min(map(len, series))
            bands = [quartiles([values[g] for values in series]) for g in range(length)]
            middle, low, high = zip(*bands)
            line, = axis.plot(range(length), middle, label=f"{arm} ({len(runs)})")
            axis.fill_between(range(length), low, high, alpha=0.2, color=line.get_color(), lw=0)
        axis.set_title(title, fontsize=10)
        axis.grid(alpha=0.3)
        axis.set_ylim(bottom=0)
    for axis in axes[1]:
        axis.set_xlabel("generation")
    axes[0][0].legend(fontsize=8)
    figure.savefig(chart, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kept", type=Path)
    parser.add_argument("run", nargs="*", metavar="FOLDER EXPERIMENT POPULATION GENERATIONS SEEDS ARM")
    parser.add_argument("--plot", type=Path)
    parser.add_argument("--arms", help="only these, in this order")
    parser.add_argument("--course", type=lambda text: [int(part) for part in text.split(",")])
    given = parser.parse_args()
    if given.run:
        if len(given.run) < 6:
            sys.exit("expected FOLDER EXPERIMENT POPULATION GENERATIONS SEEDS ARM...")
        evolve(given.kept, *given.run[:5], given.run[5:])
    runs = read_kept(given.kept)
    names = given.arms.split(",") if given.arms else list(dict.fromkeys(arm for arm, _ in runs))
    by_arm = {name: {key: rows for key, rows in runs.items() if key[0] == name} for name in names}
    if not all(by_arm.values()):
        sys.exit(f"{given.kept}: holds no arm {[n for n in names if not by_arm[n]]}")
    print_table(by_arm)
    if given.course:
        print_course(by_arm, given.course)
    if given.plot:
        plot(by_arm, given.plot)


if __name__ == "__main__":
    main()
