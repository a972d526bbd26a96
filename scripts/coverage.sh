#!/usr/bin/env bash
# Which lines the tests reach: builds the preset `coverage`, runs the tests and writes build/coverage/report/index.html.
# Arguments go to ctest. Left out are the tests of physics at length, which reach no line that the others do not, and two that a
# program which counts its lines cannot pass: it writes its counts where files must not grow, and has no time for all of a benchmark.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v gcovr > /dev/null || { echo "There is no gcovr: scripts/install_packages.sh nightly" >&2; exit 2; }
cmake --preset coverage > /dev/null
cmake --build --preset coverage
find build/coverage -name '*.gcda' -delete
ctest --test-dir build/coverage -j "$(nproc)" --output-on-failure -E '^verification|a lost disk|bench writes a page' "$@"
mkdir -p build/coverage/report
gcovr --root . --object-directory build/coverage --filter solver/ --filter vtk_io/ --filter render/ --filter app/ \
  --exclude-throw-branches --html-details build/coverage/report/index.html --print-summary
echo "build/coverage/report/index.html"
