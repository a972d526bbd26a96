#!/usr/bin/env bash
# Installs the Debian packages that a job needs and that are missing:
#   install_packages.sh compute|release|tests|benchmarks|paraview|package|nightly
set -euo pipefail

compute=(g++ cmake ninja-build libeigen3-dev libboost-dev libboost-program-options-dev libtomlplusplus-dev
         nlohmann-json3-dev libfmt-dev)
release=("${compute[@]}" libvtk9-dev libgdal-dev libosmesa6-dev libcairo2-dev libwebp-dev pkg-config fonts-dejavu-core)
tests=("${release[@]}" catch2 python3 python3-vtk9 python3-numpy chromium)
nightly=("${tests[@]}" clang libclang-rt-14-dev libomp-dev clang-tidy cppcheck gcovr)  # sanitizers, fuzzing, lint, coverage
benchmarks=("${compute[@]}" catch2 libbenchmark-dev)  # the micro-benchmarks
package=("${release[@]}" dpkg-dev file)  # packs the .deb
paraview=("${release[@]}" paraview xvfb)  # its python modules: see scripts/paraview.sh

case "${1:-}" in
  compute) wanted=("${compute[@]}") ;;
  release) wanted=("${release[@]}") ;;
  tests) wanted=("${tests[@]}") ;;
  benchmarks) wanted=("${benchmarks[@]}") ;;
  paraview) wanted=("${paraview[@]}") ;;
  package) wanted=("${package[@]}") ;;
  nightly) wanted=("${nightly[@]}") ;;
  *) echo "usage: $0 compute|release|tests|benchmarks|paraview|package|nightly" >&2; exit 2 ;;
esac

missing=()
for package in "${wanted[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

echo "Installing: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "Not root and no sudo: please install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
