# What the scripts of this folder share; to be sourced after evolve/setup.sh.
needs_of_bench='
libbenchmark-dev     header:benchmark/benchmark.h
python3              program:python3
python3-matplotlib   program:python3
python3-scipy        program:python3'

# prepare_bench TARGET...: installs what is missing and builds.
prepare_bench() {
  local tests=()
  need "$needs_of_program$needs_of_bench" || fail 'Cannot measure without these.'
  [ -f build/release/CMakeCache.txt ] || tests=(-DMETAMORPH_TESTS=OFF)
  configure release -DMETAMORPH_BENCH=ON "${tests[@]}" && build release "$@" ||
    fail 'The build failed.'
}

# Debian's packages belong to its own Python, which need not be the first.
plotting_python() {
  python3 -c 'import matplotlib' 2>/dev/null && echo python3 || echo /usr/bin/python3
}
