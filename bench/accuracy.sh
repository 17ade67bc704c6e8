#!/bin/sh
# Measures everything in bench/ACCURACY.md and draws its charts.
# usage: bench/accuracy.sh [BUILD [RANDOM]]   (default: build/release, 36 bodies of random genomes)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$root/build/release}
random=${2:-36}
tables=$build/bench/accuracy/tables
mkdir -p "$tables"
for study in predictability ablation settling stability work-precision-water \
  work-precision-land-third work-precision-land work-precision-slope; do
  echo "$study" >&2
  "$build/bench/accuracy/metamorph_accuracy" "$study" "$random" \
    "$root"/bench/genomes/*.json "$root"/bench/accuracy/genomes/*.json > "$tables/$study.csv"
done
"${PYTHON:-python3}" "$root/bench/plot_accuracy.py" "$tables" "$root/bench/charts"
