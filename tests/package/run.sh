#!/usr/bin/env bash
# Packs the three .deb, checks what they hold and depend on, and builds the example on them: run.sh
# With POROSPH_BARE, a folder with a bare Debian 12 system, they are installed and tried in a copy of that.
set -euo pipefail
cd "$(dirname "$0")/../.."
scripts/install_packages.sh package
preset=${POROSPH_PRESET:-release}
cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset" -j "$(nproc)"
rm -rf "build/$preset/packages"
(cd "build/$preset" && cpack -B packages > packages.log) || { cat "build/$preset/packages.log"; exit 1; }
cd "build/$preset/packages"
program=$(echo porosph_*.deb) development=$(echo porosph-dev_*.deb) drawings=$(echo porosph-drawings_*.deb)
dpkg-deb --field "$program" Package Version Depends
dpkg-deb --contents "$program" > contents.txt
[[ $(dpkg-deb --field "$program" Depends) == *libvtk9* ]] || { echo "the package does not depend on VTK" >&2; exit 1; }
for file in usr/bin/porosph usr/share/porosph/cases/foundation.toml usr/share/man/man1/porosph.1.gz \
  usr/share/bash-completion/completions/porosph usr/share/doc/porosph/docs/tutorial.md usr/share/doc/porosph/copyright; do
  grep -q "\./$file\$" contents.txt || { echo "$file is missing" >&2; exit 1; }
done
[[ $(dpkg-deb --field "$program" Depends) != *gdal* ]] || { echo "the program depends on GDAL" >&2; exit 1; }
[[ $(dpkg-deb --field "$drawings" Depends) == *libgdal* ]] || { echo "$drawings does not depend on GDAL" >&2; exit 1; }

work=$(mktemp -d)
clean_up() {
  if mountpoint -q "$work/bare/proc"; then umount "$work/bare/proc"; fi
  rm -rf "$work"
}
trap clean_up EXIT
if [ -n "${POROSPH_BARE:-}" ]; then
  bare=$work/bare
  mkdir "$bare"
  cp -a "$POROSPH_BARE/." "$bare"
  mount -t proc proc "$bare/proc"
  cp "$program" "$bare/tmp/"
  chroot "$bare" sh -ec "apt-get update -qq; DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends ./tmp/$program > /dev/null"
  chroot "$bare" sh -ec 'cd /root; porosph --version; porosph init; porosph run my_slope.toml --quiet --set time.end=0.3
    porosph render results/my_slope --field TotalStress:YY; porosph list; test -s results/my_slope/TotalStress_YY.png'
fi

prefix=$work/prefix
dpkg-deb --extract "$program" "$prefix"
dpkg-deb --extract "$development" "$prefix"
levee=$prefix/usr/share/porosph/cases/drawings/levee.dxf
if "$prefix/usr/bin/porosph" import "$levee" --skip frame --out "$work/levee.toml" 2> "$work/told"; then
  echo "a drawing was read without the package porosph-drawings" >&2; exit 1
fi
grep -q porosph-drawings "$work/told"
dpkg-deb --extract "$drawings" "$prefix"
"$prefix/usr/bin/porosph" import "$levee" --skip frame --out "$work/levee.toml"
../../../tests/package/example.sh "$prefix/usr" ../../..
