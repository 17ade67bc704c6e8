#!/usr/bin/env python3
"""Projects a paper-size run (2000 generations) from the last generations of a recorded one.

    python3 bench/projection.py RUN [FIRST]

RUN is the folder of a run that went on to generation FIRST (default 200) and at least 50 beyond, with
nothing else on the machine meanwhile. Prints the seconds of each phase per generation, the sizes of
the bodies, and what 2000 such generations take, as a Markdown table.
"""

import sqlite3
import sys
from pathlib import Path

GENERATIONS = 2000
LEAST = 50


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(1)


def duration(seconds):
    minutes = round(seconds / 60)
    return f"{minutes // 60} h {minutes % 60:02d} min" if minutes >= 60 else f"{minutes} min"


def main():
    if len(sys.argv) not in (2, 3):
        fail(__doc__.strip())
    database = Path(sys.argv[1]) / "run.db"
    first = int(sys.argv[2]) if len(sys.argv) == 3 else 200
    if not database.exists():
        fail(f"{database}: no such file; expected the folder of a run")
    run = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
    phases = run.execute(
        "SELECT phase, COUNT(*), SUM(seconds) FROM timings WHERE generation > ? "
        "GROUP BY phase ORDER BY SUM(seconds) DESC", (first,)).fetchall()
    count = max((n for _, n, _ in phases), default=0)
    if count < LEAST:
        fail(f"{database}: {count} generations after {first}: expected at least {LEAST}")
    sizes = run.execute(
        "SELECT t.name, t.scene, AVG(NULLIF(o.body_cells, 0)), AVG(NULLIF(o.steps, 0)), "
        "AVG(o.body_cells > 0) FROM outcomes o JOIN trials t USING (trial) "
        "WHERE o.generation > ? GROUP BY o.trial", (first,)).fetchall()

    total = sum(seconds for _, _, seconds in phases)
    print(f"{count} generations from {first + 1} on; mean of the bodies: " + "; ".join(
        f"{name} {cells:.0f} cells, {steps:.0f} steps in {scene} ({share:.0%} of the individuals)"
        for name, scene, cells, steps, share in sizes))
    print()
    print(f"| phase | seconds per generation | share | {GENERATIONS} generations |")
    print("|---|---|---|---|")
    for phase, _, seconds in phases:
        print(f"| {phase} | {seconds / count:.4f} | {seconds / total:.1%} "
              f"| {duration(seconds / count * GENERATIONS)} |")
    print(f"| together | {total / count:.4f} | | {duration(total / count * GENERATIONS)} |")


if __name__ == "__main__":
    main()
