#!/usr/bin/env bash
# The large sets of faults: fault.sh [SEED]
set -euo pipefail
cd "$(dirname "$0")/.."
seed=${1:-1}
preset=${POROSPH_PRESET:-tests}
cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset" --target porosph
porosph=build/$preset/bin/porosph
python3 tests/fault/kill_and_resume.py "$porosph" --kills 50 --seed "$seed"
python3 tests/fault/output_faults.py "$porosph" || [ $? -eq 77 ]  # parts that cannot be tried here say so
python3 tests/fault/mutated_cases.py "$porosph" cases/*.toml cases/verification/*.toml --count 500 --seed "$seed"
