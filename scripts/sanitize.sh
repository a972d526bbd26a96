#!/usr/bin/env bash
# Tests under sanitizers: sanitize.sh [address|thread] [arguments for ctest]; both where none is named. Exit status 1 where either
# reports anything. Left out are the long tests of physics, which go over the same code, and the browser.
set -euo pipefail
cd "$(dirname "$0")/.."
wanted=both
case "${1:-}" in address | thread) wanted=$1; shift ;; esac

build() {  # PRESET TARGET...
  cmake --preset "$1" > /dev/null && cmake --build --preset "$1" -j "$(nproc)" --target "${@:2}"
}

# Leaks: OSMesa, fontconfig and VTK's factories keep memory until the end on purpose. What a file asks VTK to allocate may be
# refused by the system, and is then an error of the file.
address() {
  build asan porosph unit_solver unit_run_folder unit_vtk_io unit_render unit_bench oracle app_tests || return 1
  export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1
  # Slower than without sanitizers by a factor of ten: --fault has the two seconds.
  python3 tests/fault/mutated_cases.py build/asan/bin/porosph cases/*.toml cases/verification/*.toml --count 500 --seconds 20 || return 1
  ctest --test-dir build/asan -j "$(nproc)" --output-on-failure \
    --no-tests=error --timeout 1500 -E '^(verification|stability|docs)|browser' "$@"
}

# g++'s OpenMP runtime is not known to the thread sanitizer, which then sees races that are none. clang's is, through its tool
# Archer, which tells where threads wait for each other. Libraries without the sanitizer's marks are passed over.
thread() {
  local archer
  archer=$(find /usr/lib/llvm-*/lib -name libarcher.so | sort -V | tail -n 1)
  [ -n "$archer" ] || { echo "There is no libarcher.so: scripts/install_packages.sh nightly" >&2; return 1; }
  export OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1 OMP_NUM_THREADS=4 OMP_WAIT_POLICY=passive
  build tsan porosph unit_solver unit_run_folder oracle || return 1
  # Four threads in every form, in a frame of all fields, and in runs side by side.
  local place form
  place=$(mktemp -d)
  for form in consistent proposed conventional rho_squared; do
    build/tsan/bin/porosph run cases/embankment.toml --set formulation.motion="$form" --set particles.spacing=0.5 --set time.end=0.2 \
      --threads 4 --quiet --out "$place/$form" || return 1
  done
  build/tsan/bin/porosph stability --case cases/verification/column.toml --vary time.courant=0.3,0.5 --vary loading.damping=0.01,0.02 \
    --set time.end=0.2 --jobs 4 --quiet --out "$place/stability" || return 1
  rm -r "$place"
  OMP_NUM_THREADS=2 ctest --test-dir build/tsan -j "$(nproc)" --output-on-failure --no-tests=error --timeout 1500 -R '^(unit/|oracle)' "$@"
}

failed=0
if [ "$wanted" != thread ]; then address "$@" || failed=1; fi
if [ "$wanted" != address ]; then thread "$@" || failed=1; fi
exit $failed
