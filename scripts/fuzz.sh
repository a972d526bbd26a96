#!/usr/bin/env bash
# Fuzzes the readers of cases, results and series with clang's libFuzzer: fuzz.sh [SECONDS each, default 60] [SEED, default random]
# What it learns is kept in build/fuzz/corpus. Without clang it says so and does nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60} seed=${2:-0}
command -v clang++ > /dev/null || { echo "Fuzzing is skipped: there is no clang++ (scripts/install_packages.sh nightly)"; exit 0; }

cmake --preset fuzz > /dev/null
cmake --build --preset fuzz --target fuzz_case fuzz_results fuzz_series

fuzz() {
  local name=$1 folder=build/fuzz/corpus/$1
  mkdir -p "$folder" build/fuzz/found
  build/fuzz/bin/fuzz_"$name" "$folder" tests/fuzz/corpus/"$name" -dict=tests/fuzz/"$name".dict -max_len=20000 \
    -seed="$seed" -timeout=20 -rss_limit_mb=2500 -max_total_time="$seconds" -print_final_stats=1 \
    -artifact_prefix=build/fuzz/found/"$name"_ > build/fuzz/"$name".log 2>&1 || return 1
  echo "$name: $(grep -c . < <(ls "$folder")) inputs kept, $(sed -n 's/stat::number_of_executed_units: //p' build/fuzz/"$name".log) tried, no fault"
}

declare -A jobs
for name in case results series; do
  fuzz "$name" &
  jobs[$name]=$!
done
failed=0
for name in "${!jobs[@]}"; do
  wait "${jobs[$name]}" || { failed=1; echo "$name: FAILED"; tail -60 build/fuzz/"$name".log; }
done
exit $failed
