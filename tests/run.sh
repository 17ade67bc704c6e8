#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests:
#   bash tests/run.sh           everything but the slow tests
#   bash tests/run.sh --quick   the release build and its short tests only
#   bash tests/run.sh --slow    everything, and the slow tests
# Prints what failed and how long each part took; the last line counts what passed and failed.
. "$(dirname "${BASH_SOURCE[0]}")/../evolve/setup.sh"

mode=default
case "${1:-}" in
  '') ;;
  --quick) mode=quick ;;
  --slow) mode=slow ;;
  *) fail "usage: bash tests/run.sh [--quick | --slow]" ;;
esac

SECONDS=0
passed=0
failed=0
skipped=0
# Several tests run at once; each of them asks for the number of threads it is about.
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-2} OMP_WAIT_POLICY=passive

# part NAME COMMAND...: runs the command and counts it as one check.
part() {
  local name=$1 start=$SECONDS
  shift
  if "$@"; then
    passed=$((passed + 1))
    say "ok      $name ($(took $((SECONDS - start))))"
  else
    failed=$((failed + 1))
    say "FAILED  $name ($(took $((SECONDS - start))))"
    return 1
  fi
}

skip() {
  skipped=$((skipped + 1))
  say "skipped $1: $2"
}

# run_ctest NAME PRESET [ctest options]: counts the tests one by one.
run_ctest() {
  local name=$1 preset=$2 start=$SECONDS log="build/$2/ctest.log" bad total
  shift 2
  ctest --test-dir "build/$preset" --parallel "$jobs" --output-on-failure --timeout 900 \
    --no-tests=error "$@" >"$log" 2>&1
  read -r bad total < <(sed -nE \
    's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$/\1 \2/p' "$log" | tail -n 1)
  if [ -z "${total:-}" ]; then
    bad=1 total=1
  fi
  passed=$((passed + total - bad))
  failed=$((failed + bad))
  if [ "$bad" = 0 ]; then
    say "ok      $name: $total tests ($(took $((SECONDS - start))))"
  else
    grep -vE '^ *(Start +[0-9]+:|[0-9]+/[0-9]+ Test .* Passed )' "$log"
    say "FAILED  $name: $bad of $total tests ($(took $((SECONDS - start))))"
  fi
}

# can_run FLAGS: a program compiled with these sanitizers starts on this machine. (Some containers
# forbid what they need.)
can_run() {
  local dir
  dir=$(mktemp -d)
  printf 'int main() { return 0; }\n' >"$dir/probe.cpp"
  "$@" "$dir/probe.cpp" -o "$dir/probe" >/dev/null 2>&1 && "$dir/probe" >/dev/null 2>&1
  local result=$?
  rm -rf "$dir"
  return $result
}

format_check() {
  find kernels core evolve tests bench -name '*.h' -o -name '*.cpp' |
    xargs clang-format-19 --dry-run --Werror
}

# Pages of the public headers, to read in build/doc/html.
doc_build() {
  mkdir -p build/doc && doxygen Doxyfile
}

# The same run by a program with registers of 16 bytes, where this machine's are longer.
narrow_check() {
  local runs program
  runs=$(mktemp -d) && build_all narrow || return
  for program in release narrow; do
    "build/$program/evolve/metamorph" evolve evolve/experiments/water-to-land-novelty.toml \
      --generations 8 --out "$runs/$program" >"$runs/log" 2>&1 || { cat "$runs/log" && return 1; }
  done
  python3 tests/same_digests.py "$runs/release" "$runs/narrow" && rm -rf "$runs"
}

release_tier() {
  part 'release build' build_all release -DMETAMORPH_TESTS=ON -DMETAMORPH_BENCH=ON || return
  run_ctest 'short tests' release --label-regex short
  [ "$mode" = slow ] || return 0
  run_ctest 'slow tests' release --label-regex slow
  part 'the same bits with narrower registers' narrow_check
}

build_all() {
  configure "$@" && build "$1"
}

build_thread_tests() {
  configure tsan && build tsan thread_tests
}

# What clang says of every file that the sanitizers' builds do not compile or compile with
# precompiled headers, which may bring what a file forgot to include. Nothing is written.
clang_check() {
  configure clang -DMETAMORPH_TESTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON &&
    python3 tests/syntax_check.py build/clang "$jobs"
}

clang_tier() {
  part 'clang, warnings are errors' clang_check
}

address_tier() {
  local compiler=clang++-19
  command -v $compiler >/dev/null || compiler=c++
  if ! can_run $compiler -fsanitize=address,undefined; then
    skip 'address and undefined behaviour sanitizers' 'they do not run on this machine'
    return
  fi
  part 'build with address and undefined behaviour sanitizers' \
    build_all asan -DCMAKE_CXX_COMPILER=$compiler || return
  LSAN_OPTIONS=suppressions=$root/tests/leaks.supp:print_suppressions=0 \
    run_ctest 'tests under address and undefined behaviour sanitizers' asan \
    --label-regex short --label-exclude unsanitized
}

# Archer tells the thread sanitizer about OpenMP's own synchronisation; without it every barrier
# looks like a race.
thread_tier() {
  local archer
  archer=$(ls /usr/lib/llvm-19/lib/libarcher.so 2>/dev/null)
  if [ -z "$archer" ] || ! can_run clang++-19 -fsanitize=thread; then
    skip 'thread sanitizer' 'it does not run on this machine'
    return
  fi
  export OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS=ignore_noninstrumented_modules=1
  part 'build with the thread sanitizer' build_thread_tests &&
    run_ctest 'tests under the thread sanitizer' tsan --label-regex threads
  unset OMP_TOOL_LIBRARIES TSAN_OPTIONS
}

need "$needs_of_program$needs_of_tests" || fail 'Cannot build without these.'
[ "$mode" = quick ] || need "$needs_of_pages" || say 'Without a browser the pages are not opened.'
[ $SECONDS -gt 2 ] && say "set-up took $(took $SECONDS)"

release_tier
if [ "$mode" != quick ]; then
  need "$needs_of_checks"
  if command -v clang-format-19 >/dev/null; then
    part 'format' format_check
  else
    skip 'format' 'no clang-format-19'
  fi
  if command -v doxygen >/dev/null; then
    part 'pages of the public headers' doc_build
  else
    skip 'pages of the public headers' 'no doxygen'
  fi
  if command -v clang++-19 >/dev/null; then
    clang_tier
    thread_tier
  else
    skip 'clang and thread sanitizer' 'no clang++-19'
  fi
  address_tier
fi

say "everything took $(took $SECONDS); $skipped parts skipped"
say "$passed passed, $failed failed"
[ "$failed" = 0 ]
