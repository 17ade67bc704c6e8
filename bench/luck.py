#!/usr/bin/env python3
"""Says how much of a recorded distance was luck: champions run again from many fresh starts.

    python3 bench/luck.py [--starts N] [--best] [--program FILE] RUN...

RUN is the folder of a run. Of each the champion of the last generation, with --best the one with
the highest eq 6 of all, is run from N (default 24) starts up to 1e-3 d away that the search never
saw, in double precision. Prints, as a Markdown table, the recorded distance of every trial, the
median over the fresh starts (those that fail are left out and counted), what of the recorded
distance is lost in it, the same of eq 6, and the seconds per generation that the run took.
Negative: gained.
--program is build/release/evolve/metamorph unless given.
"""

import argparse
import json
import math
import sqlite3
import subprocess
import sys
from pathlib import Path

PROGRAM = Path(__file__).resolve().parent.parent / "build/release/evolve/metamorph"


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(1)


def arguments():
    parser = argparse.ArgumentParser(add_help=False)
    parser.error = lambda message: fail(f"{__doc__.strip()}\n\n{message}")
    parser.add_argument("--starts", type=int, default=24)
    parser.add_argument("--best", action="store_true")
    parser.add_argument("--program", type=Path, default=PROGRAM)
    parser.add_argument("runs", metavar="RUN", nargs="+", type=Path)
    given = parser.parse_args()
    if not 1 <= given.starts <= 1000:
        fail(f"--starts {given.starts}: expected 1 to 1000")
    if not given.program.exists():
        fail(f"{given.program}: no such file; expected the program metamorph")
    return given


def recorded(database):
    """Generations done and seconds per generation, writing of the record included."""
    if not database.exists():
        fail(f"{database}: no such file; expected the folder of a run")
    run = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
    (generations,) = run.execute("SELECT count(*) FROM generations").fetchone()
    if generations == 0:
        fail(f"{database}: no generation is recorded yet")
    (seconds,) = run.execute("SELECT sum(seconds) FROM timings").fetchone()
    return generations, seconds / generations


def audited(given, run, generations):
    """The lines of the audit, one per trial, of one champion."""
    choice = [] if given.best else ["--from", str(generations - 1)]
    told = subprocess.run(
        [given.program, "audit", run, "--json", "--nearby-in-water", "--champions", "1",
         "--nearby", str(given.starts), *choice], stdout=subprocess.PIPE, text=True)
    if told.returncode != 0:
        sys.exit(told.returncode)
    return [json.loads(line) for line in told.stdout.splitlines()[:-1]]


def lost(before, after):
    return f"{1 - after / before:.1%}" if before > 0 else ""


def rows(given, run):
    generations, seconds = recorded(run / "run.db")
    trials = audited(given, run, generations)
    fresh = []
    for trial in trials:
        name, generation = trial["trial"], trial["generation"]
        distance, disturbed = trial.get("recorded_distance", 0), trial.get("disturbed")
        bits = "" if trial.get("same_bits", True) else " (other bits)"
        if disturbed is None:  # not run, or a failure on record
            yield f"| {run} | {generation} | {name}{bits} | {distance:.3f} | | | | |"
            continue
        fresh.append(disturbed["median"])
        failed = f"{disturbed['failed']} of {disturbed['starts']}"
        yield (f"| {run} | {generation} | {name}{bits} | {distance:.3f} | {fresh[-1]:.3f} "
               f"| {lost(distance, fresh[-1])} | {failed} | |")
    eq6 = trials[0]["eq6"]["recorded"]
    line = f"| {run} | {trials[0]['generation']} | eq 6 | {eq6:.3f} |"
    if len(fresh) == len(trials):
        # With the penalty for too many cells, which no start changes.
        unpunished = math.prod(t["recorded_distance"] for t in trials) ** (1 / len(trials))
        after = eq6 * math.prod(fresh) ** (1 / len(fresh)) / unpunished if unpunished > 0 else 0
        line += f" {after:.3f} | {lost(eq6, after)} | | {seconds:.3f} |"
    else:
        line += f" | | | {seconds:.3f} |"
    yield line


def main():
    given = arguments()
    columns = ("run", "generation", "trial", "recorded, d", "fresh starts, d", "lost", "failed",
               "s per generation")
    print(f"| {' | '.join(columns)} |")
    print("|---" * len(columns) + "|")
    for run in given.runs:
        for row in rows(given, run):
            print(row, flush=True)


if __name__ == "__main__":
    main()
