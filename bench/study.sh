#!/usr/bin/env bash
# A small study: three searches from water to land, several seeds each, and all plots of them
# (about an hour and a quarter of one core; runs that are there already go on where they stopped):
#   bash bench/study.sh FOLDER              runs and plots go to FOLDER
#   bash bench/study.sh FOLDER --plot       draws what is there, runs nothing
# SEEDS, POPULATION, GENERATIONS and SEARCHES in the environment replace "1 2 3 4 5", 100, 60 and
# "simple novelty progressive"; METAMORPH names another program than that of the release build.
folder=${1:?"usage: bash bench/study.sh FOLDER [--plot]"}
. "$(dirname "${BASH_SOURCE[0]}")/evolve_run.sh"
mkdir -p "$folder/plots" || exit 1

# Seed by seed, so that what is there at any time compares the searches.
if [ "$2" != --plot ]; then
  for seed in ${SEEDS:-1 2 3 4 5}; do
    for search in ${SEARCHES:-simple novelty progressive}; do
      evolve_run "water-to-land-$search" "$seed" "$folder/$search-$seed" \
        "${POPULATION:-100}" "${GENERATIONS:-60}" || exit
    done
  done
fi

plot() { # name, kind, runs and options
  local name=$1 kind=$2
  shift 2
  "$metamorph" plot "$@" --kind "$kind" --out "$folder/plots/$name.svg" \
    --csv "$folder/plots/$name.csv" --overwrite &&
    "$metamorph" plot "$@" --kind "$kind" --out "$folder/plots/$name.png" --overwrite
}

shopt -s nullglob
runs=("$folder"/*-*/run.db)
[ ${#runs[@]} -gt 0 ] || { echo "$folder: no run" >&2; exit 1; }
for kind in fitness distances cells metamorphosis species failures time; do
  bred=("${runs[@]}")
  # Species are bred by some searches only.
  [ "$kind" = species ] && bred=("$folder"/{simple,novelty,progressive}-*/run.db)
  [ ${#bred[@]} -gt 0 ] && { plot "$kind" "$kind" "${bred[@]}" || exit; }
done
# Figures 10, 11 and 13 to 18 have these curves alone.
plot best fitness "${runs[@]}" --curves best && plot champions distances "${runs[@]}" --curves champion ||
  exit
archives=("$folder"/{novelty,map}-*/run.db)
if [ ${#archives[@]} -gt 0 ]; then plot archive archive "${archives[@]}"; fi
