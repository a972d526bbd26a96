#!/usr/bin/env bash
# Installs what is missing, builds with all tests and runs them. Arguments go to ctest, e.g. ./test.sh -R render
#   ./test.sh --paraview     instead: installs ParaView beside the build's own VTK and looks at runs with it
#   ./test.sh --docs [FILE]  instead: runs the shell lines of README and docs, also the long ones, in a fresh clone
#   ./test.sh --package      instead: packs the .deb, unpacks them elsewhere and builds the example on what they hold
#   ./test.sh --nightly      also runs the long ones (a million steps) and draws all stability maps in full
set -euo pipefail
cd "$(dirname "$0")"
nightly=false
if [[ ${1:-} == --nightly ]]; then nightly=true; shift; fi
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
ctest --preset "$preset" -j "$(nproc)" "$@"
if $nightly; then
  "build/$preset/bin/stability_tests" "[.nightly]"
  scripts/stability_maps.sh "build/$preset/bin/porosph"
fi
