#!/usr/bin/env bash
# The runs and pictures of evolve/view/FIGURES.md (about an hour and a quarter of one core; runs that
# are there already go on where they stopped):
#   bash bench/figures.sh FOLDER              runs go to FOLDER, pictures to evolve/view/figures
#   bash bench/figures.sh FOLDER --draw       draws from what is there, runs nothing
# SEEDS, POPULATION and GENERATIONS in the environment replace "1 2 3", 60 and 60; METAMORPH
# names another program than that of the release build.
folder=${1:?"usage: bash bench/figures.sh FOLDER [--draw]"}
. "$(dirname "${BASH_SOURCE[0]}")/evolve_run.sh"
mkdir -p "$folder" || exit 1
figures=$root/evolve/view/figures

# Seed by seed, so that what is there at any time can be compared.
if [ "$2" != --draw ]; then
  for seed in ${SEEDS:-1 2 3}; do
    for experiment in {water-to-land,land-to-water}-{simple,novelty,progressive} \
      amphibious-{600,1200} slope-{metamorphic,specialist-flat,specialist-slope}; do
      evolve_run "$experiment" "$seed" "$folder/$experiment-seed$seed" \
        "${POPULATION:-60}" "${GENERATIONS:-60}" || exit
    done
  done
fi

draw() { # picture, command, sources and options
  local picture=$figures/$1
  "$metamorph" "$2" "${@:3}" --out "$picture" --overwrite >/dev/null && echo "$picture"
}
plot() { # picture, kind, its curves, experiments
  local picture=$1 kind=$2 curves=$3 runs=() name
  for name in "${@:4}"; do runs+=("$folder/$name"-seed*/run.db); done
  draw "$picture" plot "${runs[@]}" --kind "$kind" --curves "$curves"
}

set -e
swims_first=$folder/water-to-land-simple-seed2
walks_first=$folder/land-to-water-simple-seed2
climbs=$folder/slope-metamorphic-seed1

draw 01-development.png render "$swims_first" --kind development --at 60,120,240,360,480,600 --density 0.9
for trial in larva adult; do
  motion=(--kind motion --trial $trial --snapshots 4 --density 1)
  draw 03-$trial.png render "$swims_first" "${motion[@]}"
  draw 06-$trial.png render "$walks_first" "${motion[@]}"
  draw 21-$trial.png render "$climbs" "${motion[@]}"
done
draw 04-development.png render "$swims_first" --kind development --density 0.9
draw 05-zoo.png render "$folder"/water-to-land-*-seed*/run.db --kind zoo --density 0.7
draw 07-zoo.png render "$folder"/land-to-water-*-seed*/run.db --kind zoo --density 0.7
draw 08-development.png render "$walks_first" --kind development --density 0.9
draw 09-phase.png render "$swims_first" "$walks_first" --kind zoo --colours phase --density 0.8
draw 19-history.png render "$swims_first" --kind history --density 1

plot 10a-fitness.png fitness best water-to-land-{simple,novelty,progressive}
plot 10b-fitness.png fitness best land-to-water-{simple,novelty,progressive}
plot 11-distances.png distances champion water-to-land-{simple,novelty,progressive}
plot 12-distances.png distances champion land-to-water-{simple,novelty,progressive}
plot 13-fitness.png fitness best {water-to-land,land-to-water}-novelty
plot 14-distances.png distances champion {water-to-land,land-to-water}-novelty
plot 15-cells.png cells cells {water-to-land,land-to-water}-novelty
plot 17-metamorphosis.png metamorphosis died,added {water-to-land,land-to-water}-novelty
plot 20a-fitness.png fitness best {water-to-land,land-to-water}-novelty amphibious-{600,1200}
plot 20b-distances.png distances champion {water-to-land,land-to-water}-novelty amphibious-{600,1200}
plot 22-distances.png distances champion slope-{metamorphic,specialist-flat,specialist-slope}
