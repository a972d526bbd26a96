#!/usr/bin/env bash
# Builds Porosph, computes the paper's foundation and embankment, and draws their figures.
# Options: none. Environment: JOBS, runs at a time (default: the number of cores).
set -euo pipefail
cd "$(dirname "$0")"

scripts/install_packages.sh release
cmake --preset release
cmake --build --preset release --parallel

porosph=build/release/bin/porosph
out=results/demo
figures=$out/figures
jobs_at_once=${JOBS:-$(nproc)}
mkdir -p "$out/logs" "$figures"

# run NAME CASE [SETTING...]: one thread each, several runs at a time; a failure is reported when all have ended.
failures=$out/logs/failures
: > "$failures"
run() {
  local name=$1 case_file=$2 setting status=0
  shift 2
  local settings=()
  for setting in "$@"; do settings+=(--set "$setting"); done
  "$porosph" run "$case_file" --out "$out/$name" --threads 1 --quiet "${settings[@]}" \
    > "$out/logs/${name//\//_}.log" 2>&1 || status=$?
  case "$name:$status" in
    foundation/conventional_no_tension:0)
      echo "$name came to rest, but rows of soil should have been expelled" | tee -a "$failures" >&2 ;;
    failure/conventional:0)
      echo "$name came to its end, but the pore pressure should have thrown soil off" | tee -a "$failures" >&2 ;;
    *:0) echo "  $name: done" ;;
    foundation/conventional_no_tension:3)
      echo "  $name: unstable (exit status 3), as it must be: rows of soil were expelled, as in the paper" ;;
    failure/conventional:3)
      echo "  $name: unstable (exit status 3), as it must be: the pore pressure threw soil off" ;;
    *) echo "$name failed with exit status $status: $(cat "$out/logs/${name//\//_}.log")" | tee -a "$failures" >&2 ;;
  esac
}
start() {
  while [ "$(jobs -pr | wc -l)" -ge "$jobs_at_once" ]; do wait -n; done
  run "$@" &
}

echo "Computing, $jobs_at_once runs at a time, into $out:"
foundation=cases/foundation.toml
embankment=cases/embankment.toml
sooner=(time.courant=0.4 loading.damping=0.004)  # twice the time step, the same damping c_d = xi / dt
no_tension=(soil.0.no_tension=true time.end=1)
run foundation/conventional_no_tension "$foundation" formulation.motion=conventional "${no_tension[@]}"
# It breaks down within a second of computing; the other form writes a frame of the same time, to compare.
broken=$(sed -n 's/.*timestep="\([^"]*\)".*/\1/p' "$out/foundation/conventional_no_tension/particles.pvd" | tail -n 1)
start embankment/proposed "$embankment" formulation.motion=proposed "${sooner[@]}"
start embankment/consistent "$embankment" "${sooner[@]}"
start foundation/proposed "$foundation" formulation.motion=proposed
start foundation/proposed_uncorrected "$foundation" formulation.motion=proposed formulation.kernel_correction=false \
  "${sooner[@]}"
start foundation/proposed_undamped "$foundation" formulation.motion=proposed time.courant=0.4 loading.damping=0
start foundation/conventional "$foundation" formulation.motion=conventional "${sooner[@]}"
start foundation/consistent "$foundation"
for form in conventional proposed consistent; do
  start "failure/$form" cases/failure/submerged_slide.toml "formulation.motion=$form"
done
start foundation/proposed_no_tension "$foundation" formulation.motion=proposed "${no_tension[@]}" "output.times=[$broken]"
wait
[ ! -s "$failures" ] || exit 1
"$porosph" fem "$embankment" --out "$out/embankment/fem"

echo "Drawing:"
f=$out/foundation
e=$out/embankment
singular=(--leave-out 10,6,1 --leave-out 33,6,1 --leave-out 15,11,0.5 --leave-out 20.5,11,0.5)  # toes, crest corners
# draw ARGUMENTS...: as run, several at a time.
draw() {
  while [ "$(jobs -pr | wc -l)" -ge "$jobs_at_once" ]; do wait -n; done
  ("$porosph" "$@" >> "$out/logs/figures.log" || echo "porosph $* failed" | tee -a "$failures" >&2) &
}
uncorrected=(--label "proposed, without kernel correction")
undamped=(--label "proposed, undamped")
conventional=(--label conventional) proposed=(--label proposed) consistent=(--label consistent)
draw compare "$f/conventional_no_tension" "$f/proposed_no_tension" --time common --field TotalStress:YY \
  --label "conventional, no tension" --label "proposed, no tension" --out "$out/compare/no_tension"
draw compare "$f/conventional" "$f/proposed" --field TotalStress:YY --out "$out/compare/elastic"
draw compare "$e/proposed" "$e/consistent" --fem "$e/fem" "${singular[@]}" --out "$out/compare/embankment"
draw report "$f/proposed" "$f/proposed_uncorrected" "$f/consistent" "${proposed[@]}" "${uncorrected[@]}" \
  "${consistent[@]}" --out "$out/report/figure_4"
draw report "$f/proposed" "$f/proposed_undamped" "${proposed[@]}" "${undamped[@]}" --out "$out/report/figure_5"
draw report "$f/conventional" "$f/proposed" "$f/proposed_uncorrected" "$f/proposed_undamped" "$f/consistent" \
  "${conventional[@]}" "${proposed[@]}" "${uncorrected[@]}" "${undamped[@]}" "${consistent[@]}" \
  --out "$out/report/foundation"
draw report "$e/proposed" "$e/consistent" --fem "$e/fem" "${singular[@]}" --out "$out/report/embankment" \
  --fail-if 'fem.EffectiveStress_YY.relative_l2>0.04'
draw report "$out/failure/conventional" "$out/failure/proposed" "$out/failure/consistent" "${conventional[@]}" \
  "${proposed[@]}" "${consistent[@]}" --field PlasticStrain --out "$out/report/slide"
draw safety cases/safety/griffiths_lane_1.toml --out "$out/safety"
wait
[ ! -s "$failures" ] || exit 1
cp "$out/compare/no_tension/TotalStress_YY.png" "$figures/figure_3_no_tension.png"
cp "$out/compare/elastic/TotalStress_YY.png" "$figures/figure_3_elastic.png"
cp "$out/report/figure_4/history.png" "$figures/figure_4.png"
cp "$out/report/figure_5/history.png" "$figures/figure_5.png"
cp "$out/report/embankment/contours_TotalStress_YY.png" "$figures/figure_7.png"
cp "$out/report/embankment/history_A.png" "$figures/figure_8.png"
cp "$out/report/slide/contours_PlasticStrain.png" "$figures/slide.png"
cp "$out/safety/mechanism.png" "$figures/safety.png"

cat <<END

Look at
  $figures/figure_3_no_tension.png
      total vertical stress, soil without tension: the conventional form expels rows of soil, the proposed one does not
  $figures/figure_3_elastic.png
      the same, elastic soil: the conventional form lifts the whole column by the pore pressure at the ground
  $figures/figure_4.png
      effective vertical stress at A and B with theory: with and without kernel correction, and the consistent form
  $figures/figure_5.png
      the same with and without damping; the thin line is the exact vibration of an undamped column
  $figures/figure_7.png
      total vertical stress in the embankment beside finite elements
  $figures/figure_8.png
      the four effective stresses at A in the embankment, with what finite elements give
  $figures/slide.png
      a slope that slides under water: the conventional form throws soil off within a second, the others let it slide
  $figures/safety.png
      how a slope with a factor of safety of 1.36 fails, and the slip surface of limit equilibrium; more in $out/safety/index.html
  $out/report/foundation/index.html
      all of the foundation's runs: pictures, histories, errors, settings (open it in a browser)
  $out/report/embankment/index.html
      the same of the embankment, against finite elements
  $out/compare/*/comparison.csv
      the differences between runs in numbers
  $out/foundation/proposed/particles.pvd
      the series for ParaView: paraview --script=$out/foundation/proposed/open_in_paraview.py
END
