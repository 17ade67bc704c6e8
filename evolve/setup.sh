# Shared by evolve/run.sh and tests/run.sh, which source it: finds or installs what a build needs,
# then configures and builds a preset. Works from any folder; leaves the caller in the source tree.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1

say() { printf '%s\n' "$*"; }
fail() {
  printf '%s\n' "$*" >&2
  exit 1
}
took() { printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); }

# Two lines per core are never more compilers than the memory can hold (about 1.5 GB each).
job_count() {
  local cores memory
  cores=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
  memory=$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null)
  [ -n "$memory" ] && [ "$memory" -lt "$cores" ] && cores=$memory
  [ "$cores" -ge 1 ] && echo "$cores" || echo 1
}
jobs=${JOBS:-$(job_count)}

# What is needed: Debian package, and how to see that it is there on any system: a program, or a
# header to include (alternatives by comma).
needs_of_program='
cmake                program:cmake
ninja-build          program:ninja,make
g++                  program:c++,g++,clang++
pkg-config           program:pkg-config,pkgconf
libeigen3-dev        header:eigen3/Eigen/Core,Eigen/Core
libcgal-dev          header:CGAL/version.h
librandom123-dev     header:Random123/philox.h
libfmt-dev           header:fmt/core.h
libcli11-dev         header:CLI/CLI.hpp
libtomlplusplus-dev  header:toml++/toml.h
nlohmann-json3-dev   header:nlohmann/json.hpp
libsqlite3-dev       header:sqlite3.h
libxxhash-dev        header:xxhash.h
libcairo2-dev        header:cairo/cairo.h,cairo.h
zlib1g-dev           header:zlib.h
libpng-dev           header:png.h
libimagequant-dev    header:libimagequant.h'
needs_of_tests='
libgtest-dev         header:gtest/gtest.h
libgmock-dev         header:gmock/gmock.h
librapidcheck-dev    header:rapidcheck.h
libbenchmark-dev     header:benchmark/benchmark.h
python3              program:python3'
# A browser opens the pages of `metamorph replay`.
needs_of_pages='
chromium             program:chromium,chromium-browser,google-chrome'
needs_of_checks='
clang-19             program:clang++-19
libclang-rt-19-dev   program:clang++-19
libomp-19-dev        program:clang++-19
clang-format-19      program:clang-format-19
doxygen              program:doxygen
ffmpeg               program:ffmpeg'

is_debian_12() {
  local ID='' VERSION_ID=''
  [ -r /etc/os-release ] && . /etc/os-release
  [ "$ID" = debian ] && [ "$VERSION_ID" = 12 ]
}

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# is_there KIND:NAME,NAME,...
is_there() {
  local name compiler
  for name in $(printf '%s' "${1#*:}" | tr ',' ' '); do
    if [ "${1%%:*}" = program ]; then
      command -v "$name" >/dev/null 2>&1 && return 0
    else
      for compiler in "${CXX:-c++}" g++ clang++; do
        printf '#include <%s>\n' "$name" | "$compiler" -std=c++20 -E -x c++ - >/dev/null 2>&1 &&
          return 0
      done
    fi
  done
  return 1
}

# missing_of LIST: the packages of the list that are not there.
missing_of() {
  local package probe
  while read -r package probe; do
    [ -n "$package" ] || continue
    if is_debian_12; then is_installed "$package"; else is_there "$probe"; fi ||
      printf '%s ' "$package"
  done <<<"$1"
}

apt_install() {
  local sudo=''
  [ "$(id -u)" = 0 ] || sudo='sudo -n'
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends \
    -o DPkg::Lock::Timeout=600 "$@"
}

# need LIST: installs what is missing of the list where that is possible. Returns non-zero, having
# named it, if something is still missing.
need() {
  local missing log
  missing=$(missing_of "$1")
  [ -n "$missing" ] || return 0
  if is_debian_12 && { [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null || sudo -v 2>/dev/null; }; then
    say "Installing: $missing"
    log=$(mktemp)
    # The package lists are fetched only if the install does not work with those at hand.
    apt_install install $missing >"$log" 2>&1 ||
      { apt_install update >"$log" 2>&1 && apt_install install $missing >"$log" 2>&1; } ||
      tail -n 15 "$log" >&2
    rm -f "$log"
    missing=$(missing_of "$1")
    [ -n "$missing" ] || return 0
  fi
  printf 'Missing (names of the Debian packages): %s\n' "$missing" >&2
  is_debian_12 && printf 'Install them with: apt-get install %s\n' "$missing" >&2
  return 1
}

# configure PRESET [cmake options]: in build/PRESET, with Ninja where there is one. A build tree of
# a source tree that was moved, or of another generator, is started afresh.
configure() {
  local preset=$1 cache="build/$1/CMakeCache.txt" generator='Unix Makefiles' log
  shift
  command -v ninja >/dev/null 2>&1 && generator=Ninja
  if [ -f "$cache" ] && ! { grep -qx "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache" &&
    grep -qx "CMAKE_GENERATOR:INTERNAL=$generator" "$cache"; }; then
    rm -rf "$cache" "build/$preset/CMakeFiles"
  fi
  # ccache keeps nothing that was compiled with precompiled headers.
  command -v ccache >/dev/null 2>&1 &&
    set -- -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON "$@"
  mkdir -p "build/$preset"
  log="build/$preset/configure.log"
  cmake --preset "$preset" -G "$generator" "$@" >"$log" 2>&1 || {
    cat "$log" >&2
    return 1
  }
}

# build PRESET [targets]: quiet unless something fails; on a terminal the build tool shows progress.
build() {
  local preset=$1 log="build/$1/build.log"
  shift
  if [ -t 1 ]; then
    cmake --build "build/$preset" --parallel "$jobs" ${1:+--target "$@"}
  else
    cmake --build "build/$preset" --parallel "$jobs" ${1:+--target "$@"} >"$log" 2>&1 || {
      tail -n 60 "$log" >&2
      return 1
    }
  fi
}
