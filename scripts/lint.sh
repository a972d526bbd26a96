#!/usr/bin/env bash
# Looks for mistakes with cppcheck and clang-tidy: lint.sh [FILE...], all sources where none is named.
# Which checks: .clang-tidy. What is passed over, and why: scripts/cppcheck_suppressions.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
for program in cppcheck clang-tidy; do
  command -v $program > /dev/null || { echo "There is no $program: scripts/install_packages.sh nightly" >&2; exit 2; }
done
if [ $# -gt 0 ]; then sources=("$@"); else mapfile -t sources < <(git ls-files 'solver/*.cpp' 'vtk_io/*.cpp' 'render/*.cpp' 'app/*.cpp'); fi

cppcheck --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --quiet -I. \
  --suppressions-list=scripts/cppcheck_suppressions.txt -DPOROSPH_HAS_VTK -DPOROSPH_VERSION='""' \
  -j "$(nproc)" --error-exitcode=1 "${sources[@]}"

# clang needs its own OpenMP header and no option of g++'s alone.
cmake --preset tests -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DPOROSPH_TESTS=OFF -B build/lint > /dev/null
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p build/lint
