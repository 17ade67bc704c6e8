#!/usr/bin/env python3
"""Compares settings of an experiment over several seeds: runs each, prints a table.

    python3 bench/arms.py FOLDER EXPERIMENT.toml POPULATION GENERATIONS SEEDS ARM...

FOLDER gets one run per arm and seed, NAME-SEED; runs that are there already are only read. SEEDS is
a list as in 1,2,3. An ARM is NAME or NAME:KEY=VALUE;KEY=VALUE..., keys as `metamorph evolve --set`
has them. Each run has one thread, as many run at once as there are cores. The program is
build/release/evolve/metamorph, or what METAMORPH names.

Prints, as a Markdown table, per arm: the best eq 6 of every seed and their median, the median of
the population's mean eq 6 over the last five generations, the share of the evaluated bodies that
failed, those that were not settled, and the seconds of locomotion per generation.
"""

import os
import sqlite3
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("METAMORPH", str(ROOT / "build/release/evolve/metamorph"))
NO_BODY = ("empty", "no_body")
RAN = ("ok", "not_settled")


def evolve(job):
    folder, experiment, population, generations, seed, settings = job
    if not (folder / "run.db").exists():
        command = [PROGRAM, "evolve", experiment, "--out", str(folder), "--population", population,
                   "--generations", generations, "--seed", seed, "--threads", "1"]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{folder}: {done.stderr.strip()}")
    return measure(folder)


def measure(folder):
    with sqlite3.connect(f"file:{folder / 'run.db'}?mode=ro", uri=True) as record:
        def value(query):
            return record.execute(query).fetchone()[0]
        status = dict(record.execute("SELECT status, sum(count) FROM status_counts GROUP BY status"))
        bodies = sum(count for name, count in status.items() if name not in NO_BODY)
        ran = sum(status.get(name, 0) for name in RAN)
        last = value("SELECT max(generation) FROM generations")
        return {"best": value("SELECT max(best_eq6) FROM generations"),
                "mean": value(f"SELECT avg(mean_eq6) FROM generations WHERE generation > {last - 5}"),
                "failed": (bodies - ran) / max(bodies, 1),
                "not_settled": status.get("not_settled", 0) / max(bodies, 1),
                "seconds": value("SELECT sum(seconds) FROM timings WHERE phase = 'locomotion'")
                / (last + 1)}


def main(folder, experiment, population, generations, seeds, *arms):
    seeds = seeds.split(",")
    jobs = []
    for arm in arms:
        name, _, settings = arm.partition(":")
        jobs += [(Path(folder) / f"{name}-{seed}", experiment, population, generations, seed,
                  [s for s in settings.split(";") if s]) for seed in seeds]
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        results = list(workers.map(evolve, jobs))
    print("| arm | best eq 6, each seed, d | median | mean eq 6, median | failed | not settled "
          "| s per generation |\n|---|---|---|---|---|---|---|")
    for n, arm in enumerate(arms):
        mine = results[n * len(seeds):(n + 1) * len(seeds)]
        bests = sorted(run["best"] for run in mine)

        def middle(key):
            return statistics.median(run[key] for run in mine)
        print(f"| {arm.partition(':')[0]} | {' '.join(f'{best:.1f}' for best in bests)} "
              f"| {statistics.median(bests):.1f} | {middle('mean'):.1f} "
              f"| {100 * middle('failed'):.2f} % | {100 * middle('not_settled'):.1f} % "
              f"| {middle('seconds'):.2f} |")


if __name__ == "__main__":
    if len(sys.argv) < 7:
        sys.exit(__doc__)
    main(*sys.argv[1:])
