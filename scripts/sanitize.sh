#!/usr/bin/env bash
# The tests under sanitizers. Arguments go to ctest. The long tests of physics are left out: they go over the same code.
set -euo pipefail
cd "$(dirname "$0")/.."

# Leaks: OSMesa, fontconfig and VTK's factories keep memory until the end on purpose.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
cmake --preset asan > /dev/null
cmake --build --preset asan
ctest --test-dir build/asan --output-on-failure -E '^verification|browser' "$@"

# g++'s OpenMP runtime is not known to the thread sanitizer, which then sees races that are none. With clang's it is, through
# Archer, which tells it where threads wait for each other. Libraries without the sanitizer's marks are passed over.
archer=$(find /usr/lib/llvm-*/lib -name libarcher.so | sort -V | tail -n 1)
export OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1 OMP_NUM_THREADS=4
[ -n "$archer" ] || { echo "There is no libarcher.so: scripts/install_packages.sh nightly" >&2; exit 2; }
cmake --preset tsan > /dev/null
cmake --build --preset tsan --target unit_solver unit_run_folder oracle
ctest --test-dir build/tsan --output-on-failure -R '^unit/|^oracle' "$@"
