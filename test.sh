#!/usr/bin/env bash
# Installs what is missing, builds with all tests and runs them. Arguments go to ctest, e.g. ./test.sh -R render
# What takes longer, or needs more, stands behind options:
#   --sanitize          the tests under the address, undefined-behaviour and thread sanitizers
#   --fault             50 kills at random moments, 500 cases with random mistakes, lost disks and folders
#   --fuzz [SECONDS]    the readers under libFuzzer
#   --lint [FILE...]    cppcheck and clang-tidy
#   --coverage          which lines the tests reach
#   --paraview          ParaView, installed beside the build's own VTK, looks at runs
#   --docs [FILE]       the shell lines of README and docs, also the long ones, in a fresh clone
#   --package           packs the .deb, unpacks them elsewhere and builds the example on what they hold
#   --nightly           all tests, then the long ones (a million steps) and all stability maps in full
set -euo pipefail
cd "$(dirname "$0")"
case "${1:-}" in
  --sanitize | --fault | --fuzz | --lint | --coverage)
    scripts/install_packages.sh nightly
    exec scripts/"${1#--}".sh "${@:2}" ;;
esac
nightly=false
if [[ ${1:-} == --nightly ]]; then nightly=true; export POROSPH_NIGHTLY=1; shift; fi
preset=${POROSPH_PRESET:-tests}
build() {  # [--target NAME]
  cmake --preset "$preset" > /dev/null
  cmake --build --preset "$preset" -j "$(nproc)" "$@"
}

case "${1:-}" in
  --paraview)
    scripts/install_packages.sh paraview
    build --target porosph
    exec tests/paraview/run.sh "build/$preset/bin/porosph"
    ;;
  --docs)
    exec tests/docs/run_docs.py . --long "${@:2}"
    ;;
  --package)
    exec tests/package/run.sh
    ;;
esac
scripts/install_packages.sh tests
build
# One more than there are cores: some wait for browsers and interrupted runs.
ctest --preset "$preset" -j "$(($(nproc) + 1))" "$@"
if $nightly; then
  "build/$preset/bin/stability_tests" "[.nightly]"
  scripts/stability_maps.sh "build/$preset/bin/porosph"
fi
