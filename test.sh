#!/usr/bin/env bash
# Installs what is missing, builds with all tests and runs them. Arguments go to ctest, e.g. ./test.sh -R render
# What takes longer stands behind options:
#   --sanitize          the tests under the address, undefined-behaviour and thread sanitizers
#   --fault             50 kills at random moments, 500 cases with random mistakes, lost disks and folders
#   --fuzz [SECONDS]    the readers under libFuzzer
#   --lint [FILE...]    cppcheck and clang-tidy
#   --coverage          which lines the tests reach
#   --nightly           all tests, then the long ones (a million steps) and all stability maps in full
set -euo pipefail
cd "$(dirname "$0")"
case "${1:-}" in
  --sanitize | --fault | --fuzz | --lint | --coverage)
    scripts/install_packages.sh nightly
    exec scripts/"${1#--}".sh "${@:2}" ;;
esac
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
