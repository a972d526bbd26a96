#!/usr/bin/env bash
# Installs what is missing, builds with all tests and runs them. Arguments go to ctest, e.g. ./test.sh -R render
# ./test.sh --nightly also runs the long ones (a million steps) and draws all stability maps in full.
set -euo pipefail
cd "$(dirname "$0")"
nightly=false
if [[ ${1:-} == --nightly ]]; then nightly=true; shift; fi
preset=${POROSPH_PRESET:-tests}
scripts/install_packages.sh tests
cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset" -j "$(nproc)"
ctest --preset "$preset" -j "$(nproc)" "$@"
if $nightly; then
  "build/$preset/bin/stability_tests" "[.nightly]"
  scripts/stability_maps.sh "build/$preset/bin/porosph"
fi
