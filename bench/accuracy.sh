#!/usr/bin/env bash
# Installs what is missing, builds, measures everything in bench/ACCURACY.md and draws its charts
# (about four minutes on two idle cores):
#   bash bench/accuracy.sh            writes bench/charts/; tables (CSV) stay under build/
#   bash bench/accuracy.sh --quick    8 bodies of random genomes instead of 36; charts under build/
. "$(dirname "${BASH_SOURCE[0]}")/../evolve/setup.sh"
. bench/needs.sh

folder=build/release/bench/accuracy
tables=$folder/tables charts=bench/charts random=36
case "${1:-}" in
  '') ;;
  --quick) charts=$folder/charts random=8 ;;
  *) fail "usage: bash bench/accuracy.sh [--quick]" ;;
esac
prepare_bench metamorph_accuracy

mkdir -p "$tables" "$charts"
for study in predictability solidity ablation settling stability work-precision-water \
  work-precision-land-third work-precision-land work-precision-slope; do
  start=$SECONDS
  "$folder/metamorph_accuracy" "$study" "$random" bench/genomes/solid-*.json \
    bench/accuracy/genomes/*.json >"$tables/$study.csv" || exit 1
  say "$study took $(took $((SECONDS - start)))"
done
"$(plotting_python)" bench/plot_accuracy.py "$tables" "$charts"
