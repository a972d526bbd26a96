#!/usr/bin/env bash
# The files of the program that have parts for VTK or for pictures compile without them:
# without_pictures.sh COMPILER SOURCE_DIR BUILD_DIR EIGEN_DIR
set -euo pipefail
cd "$2"
left_out=$(sed -n 's/.*EXCLUDE REGEX "\/(\([^)]*\)).*/\1/p' app/CMakeLists.txt)
found=0
for file in $(grep -l 'POROSPH_HAS_\|"render/\|namespace render' app/*.cpp | grep -Ev "/($left_out)\.cpp"); do
  found=$((found + 1))
  "$1" -std=c++20 -fsyntax-only -fopenmp -Wall -Wextra -Werror -I. -I"$3/app/include" -isystem "$4" \
    -DPOROSPH_VERSION='"0"' "$file"
done
((found > 0))
