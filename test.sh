#!/usr/bin/env bash
# Installs what is missing, builds with all tests and runs them. Arguments go to ctest, e.g. ./test.sh -R render
#   ./test.sh --paraview     instead: installs ParaView beside the build's own VTK and looks at runs with it
#   ./test.sh --docs [FILE]  instead: runs the shell lines of README and docs, also the long ones, in a fresh clone
#   ./test.sh --package      instead: packs the .deb, unpacks them elsewhere and builds the example on what they hold
set -euo pipefail
cd "$(dirname "$0")"
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
