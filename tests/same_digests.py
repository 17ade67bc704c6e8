#!/usr/bin/env python3
"""Whether two runs hold the same bits: compares the digests of all that they wrote, generation by
generation and table by table. Wall-clock and machine are not among them.

usage: same_digests.py RUN RUN
"""

import sqlite3
import sys
from pathlib import Path


def digests_of(run):
    with sqlite3.connect(f"file:{Path(run) / 'run.db'}?mode=ro", uri=True) as record:
        return {(number, table): (rows, total) for number, table, rows, total in
                record.execute('SELECT number, "table", rows, sum FROM digests')}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    one, other = map(digests_of, sys.argv[1:])
    differing = sorted(key for key in one.keys() | other.keys() if one.get(key) != other.get(key))
    generations = {number for number, _ in one if number >= 0}
    if not generations:
        sys.exit(f"{sys.argv[1]}: no generation to compare")
    for number, table in differing[:5]:
        print(f"differs: generation {number}, table {table}")
    print(f"{len(generations)} generations, {len(one)} digests, {len(differing)} differ")
    sys.exit(1 if differing else 0)


main()
