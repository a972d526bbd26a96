#!/usr/bin/env bash
# The kernels of wide vector units may share no function with other files: the linker could take theirs for all.
# Usage: kernels_are_self_contained.sh OBJECT...
set -euo pipefail
[ $# -gt 0 ] || { echo "no objects given" >&2; exit 2; }
# What clang adds to call std::terminate uses no vector units.
shared=$(nm --demangle --defined-only "$@" | grep -E ' [WVu] ' | grep -vE ' (__clang_call_terminate|DW\.ref\.\S+)$' || true)
[ -z "$shared" ] || { echo "these could be linked into code for older processors:"; echo "$shared"; exit 1; } >&2
