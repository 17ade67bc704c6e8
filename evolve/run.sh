#!/usr/bin/env bash
# Installs what is missing, builds, and evolves a small water-to-land run (about two minutes
# on two cores):
#   bash evolve/run.sh [options of `metamorph evolve`, for instance --seed 7 --generations 100]
# Every call makes a new run in runs/; nothing there is overwritten.
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

SECONDS=0
need "$needs_of_program" || fail 'Cannot build without these.'
# The tests and benchmarks need more packages; where they are configured already they stay so.
options=()
[ -f build/release/CMakeCache.txt ] || options=(-DMETAMORPH_TESTS=OFF -DMETAMORPH_BENCH=OFF)
configure release "${options[@]}" && build release metamorph || fail 'The build failed.'
metamorph=build/release/evolve/metamorph
say "set-up and build took $(took $SECONDS)"

mkdir -p runs
number=1
while [ -e "runs/first-$number" ]; do number=$((number + 1)); done
out=runs/first-$number
start=$SECONDS
# Defaults of a small run, each of them unless the caller names the option.
defaults=()
while read -r option value; do
  case " $* " in *" $option"[\ =]*) ;; *) defaults+=("$option" "$value") ;; esac
done <<END
--out $out
--seed $number
--population 100
--generations 40
END
"$metamorph" evolve evolve/experiments/water-to-land-simple.toml "${defaults[@]}" "$@" || exit
[ -d "$out" ] || exit 0
say "evolution took $(took $((SECONDS - start)))"
page=$out/best.html
"$metamorph" replay "$out" --out "$page" >/dev/null || page=
say
[ -n "$page" ] && say "Open $page in a browser: the best animat, from the egg to the adult."
say "The run lies in $out: run.db is its record, best.png and best.svg show its best animat."
say "What to do next:"
say "  $metamorph info $out"
say "  $metamorph render $out --kind motion --trial adult --out $out/motion.png"
say "  $metamorph render $out --kind development --out $out/development.png"
say "  $metamorph plot $out --kind fitness --out $out/fitness.png"
say "  $metamorph replay $out --every-generation 5 --out $out/history.html"
say "  $metamorph evolve --resume $out --generations 200"
say "  bash evolve/run.sh        evolves again, with another seed"
say "  $metamorph --help         lists all commands"
