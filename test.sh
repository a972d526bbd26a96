#!/usr/bin/env bash
# Installs what is missing, builds with all tests and runs them. Arguments go to ctest, e.g. ./test.sh -R render
set -euo pipefail
cd "$(dirname "$0")"
preset=${POROSPH_PRESET:-tests}
scripts/install_packages.sh tests
cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset" -j "$(nproc)"
ctest --preset "$preset" -j "$(nproc)" "$@"
