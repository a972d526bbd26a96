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

if [ -z "${DISPLAY:-}" ]; then
  number=$(mktemp)
  Xvfb -displayfd 3 -screen 0 1600x900x24 -nolisten tcp -noreset 3> "$number" 2> /dev/null &
  server=$!
  trap 'kill "$server"; rm -f "$number"' EXIT
  until [ -s "$number" ]; do
    kill -0 "$server" || exit 1
    sleep 0.1
  done
  DISPLAY=":$(cat "$number")"
  export DISPLAY
fi

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(--user --map-root-user)
# The system's own vtk modules would be loaded in place of ParaView's: its modules lie over them, in here only.
PARAVIEW=$unpacked unshare "${as_root[@]}" --mount bash -c '
  mount --bind "$1" "$2"
  shift 2
  export LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/paraview-5.11 PATH="$PARAVIEW/usr/bin:$PATH"
  exec "$@"
' paraview "$unpacked$modules" "$modules" "$@"
