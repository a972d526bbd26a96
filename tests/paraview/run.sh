#!/usr/bin/env bash
# Computes three small runs and looks at them with real ParaView: run.sh PATH_OF_POROSPH
set -euo pipefail
porosph=$(realpath "$1")
cd "$(dirname "$0")/../.."
unset DISPLAY  # nothing shall open on the screen of whoever starts this
runs=results/paraview
rm -rf "$runs"
settings=(--set particles.spacing=0.5 --set time.courant=0.8 --set loading.damping=0.04 --set output.interval=0.5)
fields=$(tr -d '\n' << 'END'
output.fields=["Displacement", "Velocity", "EffectiveStress", "TotalStress", "PorePressure", "Density", "Mass",
  "SmoothingLength", "SoilId", "ParticleId", "PrincipalStress", "MeanStress", "DeviatoricStress", "VonMisesStress",
  "Strain", "ExcessStress"]
END
)
"$porosph" run cases/foundation.toml "${settings[@]}" --set "$fields" --set output.boundary=true --quiet --out $runs/all
"$porosph" run cases/foundation.toml "${settings[@]}" --set formulation.motion=proposed --set output.format=vtu \
  --set output.compression=lz4 --quiet --out $runs/usual
"$porosph" init $runs/drawdown.toml > /dev/null
"$porosph" run $runs/drawdown.toml --set particles.spacing=0.5 --set loading.damping=0.04 --set output.interval=0.25 \
  --set "water={level_over_time=[[0, 9], [1, 5]]}" --quiet --out $runs/drawdown
scripts/paraview.sh env PVPYTHON=pvpython pvpython tests/paraview/check_run.py $runs/all $runs/usual $runs/drawdown \
  $runs/pictures
PATH="$PWD/tests/paraview/bin:$PATH" scripts/paraview.sh tests/docs/run_docs.py . "$(dirname "$(dirname "$porosph")")" display
