#!/usr/bin/env bash
# Draws every shipped stability map in full (some minutes; an interrupted one continues where it was):
#   scripts/stability_maps.sh [PROGRAM] [FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/bin/porosph}
folder=${2:-results/stability}
nice "$program" stability cases/stability/*.toml --quiet --out "$folder"
echo "$folder/index.html"
