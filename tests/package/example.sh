#!/usr/bin/env bash
# Builds the example of a soil law on an installed Porosph, outside of the source tree, and runs it on a case of
# `porosph init`: example.sh PREFIX SOURCE_DIR
set -euo pipefail
prefix=$(realpath "$1")
source_dir=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$source_dir/examples/softening_clay" "$work/example"
cd "$work"
cmake -S example -B build -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS_RELEASE=-O1 > configure.log 2>&1 ||
  { cat configure.log; exit 1; }
cmake --build build > build.log 2>&1 || { cat build.log; exit 1; }
"$prefix/bin/porosph" init slope.toml > /dev/null
sed -i 's/^spacing = .*/spacing = 0.5/; s/^damping = .*/damping = 0.04/' slope.toml

# Strong soil stays elastic and agrees with the program itself; weak soil yields and moves further.
"$prefix/bin/porosph" run slope.toml --quiet --out elastic
build/softening_clay slope.toml strong 1e9 1e9 | tee strong.txt
build/softening_clay slope.toml weak 2e4 1e4 | tee weak.txt
grep -q '^0 of 900 particles have yielded' strong.txt
grep -Eq '^[1-9][0-9]* of 900 particles have yielded' weak.txt
"$prefix/bin/porosph" compare elastic strong --out same > same.txt
grep -E 'EffectiveStress_YY' same.txt
awk '/EffectiveStress_YY/ { found = 1; if ($2 + 0 > 1e-6) exit 1 } END { if (!found) exit 1 }' same.txt
"$prefix/bin/porosph" compare elastic weak --time common --out differs > differs.txt
grep -E 'EffectiveStress_YY' differs.txt
"$prefix/bin/porosph" render weak --field VonMisesStress 2> wrong.txt && exit 1  # not among the fields of the case
grep -q "it has Displacement" wrong.txt
"$prefix/bin/porosph" render weak --field PlasticStrain --out weak.png
