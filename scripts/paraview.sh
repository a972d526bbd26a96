#!/usr/bin/env bash
# Runs a program of Debian's ParaView (pvpython, paraview) beside the VTK that Porosph is built with, which
# python3-paraview would replace: paraview.sh PROGRAM ARGUMENT... Without a display it gets a screen of its own.
# Environment: POROSPH_PARAVIEW, the folder that python3-paraview is unpacked in (default: build/paraview).
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
unpacked=${POROSPH_PARAVIEW:-$here/build/paraview}
modules=/usr/lib/python3/dist-packages

if ! dpkg-query -W -f='${Status}' paraview xvfb 2> /dev/null | grep -q '^install ok installedinstall ok installed$'; then
  "$here/scripts/install_packages.sh" paraview
fi
if [ ! -x "$unpacked/usr/bin/pvpython" ]; then
  mkdir -p "$unpacked"
  (cd "$unpacked" && apt-get download -qq python3-paraview && dpkg -x python3-paraview_*.deb . && rm python3-paraview_*.deb)
fi

scratch=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill "$server"; rm -rf "$scratch"' EXIT
if [ -z "${DISPLAY:-}" ]; then
  Xvfb -displayfd 3 -screen 0 1600x900x24 -nolisten tcp -noreset 3> "$scratch/display" 2> /dev/null &
  server=$!
  until [ -s "$scratch/display" ]; do
    kill -0 "$server" || exit 1
    sleep 0.1
  done
  DISPLAY=":$(cat "$scratch/display")"
  export DISPLAY
fi

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(--user --map-root-user)
mkdir "$scratch/system" "$scratch/others"
# The system's own vtk modules would be loaded in place of ParaView's: its modules lie over them, in here only. What
# it does not have, such as numpy and matplotlib, is found through links.
PARAVIEW=$unpacked unshare "${as_root[@]}" --mount bash -c '
  over=$1 modules=$2 system=$3/system others=$3/others
  shift 3
  mount --bind "$modules" "$system"
  mount --bind "$over" "$modules"
  for entry in "$system"/*; do
    [ -e "$modules/${entry##*/}" ] || ln -s "$entry" "$others/"
  done
  export PYTHONPATH="$others${PYTHONPATH:+:$PYTHONPATH}"
  export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/paraview-5.11 PATH="$PARAVIEW/usr/bin:$PATH"
  exec "$@"
' paraview "$unpacked$modules" "$modules" "$scratch" "$@"
