#!/usr/bin/env bash
# Looks for mistakes with cppcheck and clang-tidy: lint.sh [FILE...], all sources where none is named. Headers are looked at
# where a source includes them. Tests and examples are cppcheck's alone: Catch2's macros are not clang-tidy's taste.
# Which checks: .clang-tidy. What is passed over, and why: scripts/cppcheck_suppressions.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
for program in cppcheck clang-tidy; do
  command -v $program > /dev/null || { echo "There is no $program: scripts/install_packages.sh nightly" >&2; exit 2; }
done
if [ $# -gt 0 ]; then
  sources=("$@") others=()
else
  mapfile -t sources < <(git ls-files 'solver/*.cpp' 'vtk_io/*.cpp' 'render/*.cpp' 'app/*.cpp')
  mapfile -t others < <(git ls-files 'tests/*.cpp' 'examples/*.cpp')
fi
failed=0

cppcheck --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --quiet -I. \
  --suppressions-list=scripts/cppcheck_suppressions.txt -DPOROSPH_HAS_VTK -DPOROSPH_VERSION='""' \
  '-DTEST_CASE(...)=static void test()'   -j "$(nproc)" --error-exitcode=1 "${sources[@]}" "${others[@]}" || failed=1

# Only to learn where the libraries' headers are, and how they are configured. (clang 14 cannot choose vector units as g++ does.)
cmake --preset tests -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DPOROSPH_TESTS=OFF -B build/lint > /dev/null
mapfile -t libraries < <(grep -oP ' -(isystem [^ "]+|D\w+(=\w+)?)(?= )' build/lint/compile_commands.json |
                         grep -vE 'NDEBUG|VECTOR_UNITS|DISPATCH' | sort -u | xargs -n 1)
flags=(-std=c++20 -fopenmp -I. "${libraries[@]}" -DPOROSPH_VECTOR_UNITS=portable -DPOROSPH_VERSION='""')

# Nearly all of clang-tidy's time goes into the libraries' headers. So the sources of a folder are read as one, where their
# names do not clash, otherwise each half of them.
together() {  # SOURCE...: prints what to look at
  if [ $# -eq 1 ]; then echo "$1"; return; fi
  local all=build/lint/${1//\//_}
  printf '#include "%s"\n' "$@" > "$all"
  if clang++ "${flags[@]}" -fsyntax-only "$all" 2> /dev/null; then echo "$all"; return; fi
  together "${@:1:$#/2}"
  together "${@:$#/2+1}"
}
folders() { printf '%s\n' "${sources[@]}" | xargs -n 1 dirname | sort -u; }
of_folder() { printf '%s\n' "${sources[@]}" | grep -x "$1/[^/]*"; }
for folder in $(folders); do
  mapfile -t found < <(of_folder "$folder")
  together "${found[@]}"
done | xargs -P "$(nproc)" -I{} clang-tidy --quiet --checks=-bugprone-suspicious-include {} -- "${flags[@]}" 2> >(grep -v 'warnings generated' >&2) || failed=1
exit $failed
