#!/usr/bin/env bash
# Installs what is missing, builds, runs every benchmark and draws the charts (about six minutes on an idle machine):
#   bash bench/run.sh           writes bench/results/<processor>.csv, <processor>-bars.csv, bench/charts/
#   bash bench/run.sh --quick   fewer and shorter repetitions; writes under build/release/bench/ only
# Leave the machine alone meanwhile: times are the least of all repetitions, but threads cannot be
# timed beside other work.
. "$(dirname "${BASH_SOURCE[0]}")/../evolve/setup.sh"
. bench/needs.sh

folder=build/release/bench
results=bench/results charts=bench/charts page=bench/SPEED.md
options=(--benchmark_repetitions=5 --benchmark_min_time=0.1)
case "${1:-}" in
  '') ;;
  --quick)
    results=$folder/results charts=$folder/charts page=
    # Batches of 10,000 and all that lasts longest are left out.
    options=(--benchmark_repetitions=2 --benchmark_min_time=0.02
      '--benchmark_filter=-batch/.*/10000|land-to-water|generation/.*/threads:1')
    ;;
  *) fail "usage: bash bench/run.sh [--quick]" ;;
esac

programs=(step alternatives development generation scaling)
prepare_bench "${programs[@]/#/bench_}"

raw=$folder/raw
rm -rf "$raw"
mkdir -p "$raw"
for program in "${programs[@]}"; do
  start=$SECONDS
  # Repetitions of all benchmarks of a program in random order: what is compared is timed side by
  # side.
  "$folder/bench_$program" "${options[@]}" --benchmark_enable_random_interleaving=true \
    --benchmark_out="$raw/bench_$program.json" --benchmark_out_format=json \
    >"$raw/bench_$program.txt" 2>&1 || { tail -n 5 "$raw/bench_$program.txt"; exit 1; }
  say "bench_$program took $(took $((SECONDS - start)))"
done
python=$(plotting_python)
"$python" bench/report.py "$raw" "$results" $page && "$python" bench/plot_speed.py "$results" "$charts"
