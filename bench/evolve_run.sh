# Begins a run of a study, or goes on with it where it stopped; sourced by study.sh and figures.sh.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
metamorph=${METAMORPH:-$root/build/release/evolve/metamorph}
[ -x "$metamorph" ] || { echo "$metamorph is missing: build it first (bash evolve/run.sh)" >&2; exit 1; }

evolve_run() { # experiment, seed, directory, individuals, generations
  if [ -e "$3/run.db" ]; then
    "$metamorph" evolve --resume "$3" --threads 1
  else
    "$metamorph" evolve "$root/evolve/experiments/$1.toml" --out "$3" --seed "$2" \
      --population "$4" --generations "$5" --threads 1
  fi </dev/null
}
