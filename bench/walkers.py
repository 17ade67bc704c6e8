#!/usr/bin/env python3
"""A sheet of the best walkers of several runs: a row of snapshots of one cycle each.

    python3 bench/walkers.py OUT.png TRIAL RUN...

Draws the best animat of every run with `metamorph render --kind motion` and puts the rows below each
other. Needs matplotlib.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PROGRAM = Path(__file__).resolve().parent.parent / "build/release/evolve/metamorph"
WIDTH = 10  # inches


def main(out, trial, *runs):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for n, run in enumerate(runs):
            picture = Path(folder) / f"{n}.png"
            subprocess.run([PROGRAM, "render", run, "--kind", "motion", "--trial", trial,
                            "--snapshots", "4", "--out", picture], check=True,
                           stdout=subprocess.DEVNULL)
            rows.append(plt.imread(picture))
    heights = [WIDTH * row.shape[0] / row.shape[1] for row in rows]
    figure, axes = plt.subplots(len(rows), 1, figsize=(WIDTH, sum(heights)), squeeze=False,
                                gridspec_kw={"height_ratios": heights, "hspace": 0.02})
    for axis, row in zip(axes[:, 0], rows):
        axis.imshow(row, interpolation="antialiased")
        axis.axis("off")
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1)
    figure.savefig(out, dpi=90)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
